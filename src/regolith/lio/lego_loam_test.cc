// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/lego_loam.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "regolith/geometry/so3.h"
#include "regolith/lio/test_scene_internal.h"

namespace regolith {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kScans = 30;

/// A second at rest, then up to 1 m/s on a curve, rocking a little.
SE3 TruthAt(double t) {
  const double s = std::max(0.0, t - 1.0);
  const double way = s < 1.0 ? 0.5 * s * s : s - 0.5;
  const double angle = way / 8.0;
  return {ExpSo3({0.01 * std::sin(2.0 * s), 0.01 * std::sin(1.5 * s), angle}),
          {8.0 * std::sin(angle), 8.0 * (1.0 - std::cos(angle)), 1.5}};
}

/// Scans are shared by the tests, since casting them costs more than matching them.
const LidarScan& ScanAt(int index) {
  static std::map<int, LidarScan> scans;
  LidarScan& scan = scans[index];
  if (scan.points.empty()) {
    TestLidar lidar;
    lidar.period = 0.1;
    const double start = 0.1 * index;
    scan = CastScan(lidar, TestYard, static_cast<uint64_t>(index),
                    [&](double time) { return TruthAt(start + time); });
    scan.stamp = FromSeconds(start);
  }
  return scan;
}

RigCalibration Rig(const SE3& T_imu_lidar = SE3()) {
  RigCalibration rig;
  rig.lidar.emplace();
  rig.lidar->T_imu_lidar = T_imu_lidar;
  return rig;
}

/// Runs the drive with each scan changed by `change(index, &scan)`.
template <typename Change>
std::vector<ScanEstimate> Drive(LegoLoam* odometry, const Change& change) {
  std::vector<ScanEstimate> estimates;
  for (int i = 0; i < kScans; ++i) {
    LidarScan scan = ScanAt(i);
    change(i, &scan);
    for (ScanEstimate& estimate : odometry->AddScan(scan)) {
      estimates.push_back(std::move(estimate));
    }
  }
  EXPECT_THAT(odometry->Finish(), IsEmpty());
  return estimates;
}

std::vector<ScanEstimate> Drive(LegoLoam* odometry) {
  return Drive(odometry, [](int, LidarScan*) {});
}

double WorstError(const std::vector<ScanEstimate>& estimates) {
  double worst = 0.0;
  for (const ScanEstimate& estimate : estimates) {
    const SE3 truth = TruthAt(0.0).Inverse() * TruthAt(ToSeconds(estimate.stamp));
    worst = std::max(worst, (truth.translation - estimate.T_world_body.translation).norm());
  }
  return worst;
}

TEST(LegoLoam, FollowsADrive) {
  ThreadPool threads(2);
  LegoLoam odometry(LegoLoamOptions(), Rig(), &threads);
  const auto estimates = Drive(&odometry);
  ASSERT_EQ(estimates.size(), static_cast<size_t>(kScans));
  EXPECT_LT(WorstError(estimates), 0.06);
  EXPECT_EQ(estimates.back().leader, "lidar");
  EXPECT_EQ(estimates.back().match.observable.degenerate_directions, 0);
  EXPECT_EQ(estimates.back().points.size(), ScanAt(kScans - 1).points.size());
  EXPECT_THAT(odometry.Notices(), IsEmpty());
}

TEST(LegoLoam, WithoutLoopsTheRefinedPosesAreThoseGivenOut) {
  ThreadPool threads(2);
  LegoLoam odometry(LegoLoamOptions(), Rig(), &threads);
  const auto estimates = Drive(&odometry);
  const Trajectory refined = *odometry.Refined();
  ASSERT_EQ(refined.size(), estimates.size());
  for (size_t i = 0; i < estimates.size(); ++i) {
    EXPECT_EQ(refined.poses()[i].time, estimates[i].stamp);
    EXPECT_LT(Minus(refined.poses()[i].T_world_body, estimates[i].T_world_body).norm(), 1e-9);
  }
}

TEST(LegoLoam, GivesTheBodysPoseAndCovariance) {
  ThreadPool threads(2);
  const SE3 T_body_lidar(ExpSo3({0.0, 0.0, 1.2}), {0.3, -0.2, 0.7});
  LegoLoam plain(LegoLoamOptions(), Rig(), &threads);
  LegoLoam mounted(LegoLoamOptions(), Rig(T_body_lidar), &threads);
  const ScanEstimate lidar = Drive(&plain).back();
  const ScanEstimate body = Drive(&mounted).back();
  const SE3 expected = T_body_lidar * lidar.T_world_body * T_body_lidar.Inverse();
  EXPECT_LT(Minus(body.T_world_body, expected).norm(), 1e-6);
  // A small error of the lidar's pose, carried over to the body's, has the body's covariance.
  Matrix6d jacobian;
  for (int i = 0; i < 6; ++i) {
    const SE3 moved = Plus(lidar.T_world_body, 1e-6 * Vector6d::Unit(i));
    jacobian.col(i) = Minus(T_body_lidar * moved * T_body_lidar.Inverse(), expected) / 1e-6;
  }
  const Matrix6d covariance = jacobian * lidar.covariance * jacobian.transpose();
  EXPECT_LT((body.covariance - covariance).norm(), 1e-3 * covariance.norm());
}

TEST(LegoLoam, EmptyScansAreBridgedAndReported) {
  ThreadPool threads(2);
  LegoLoam odometry(LegoLoamOptions(), Rig(), &threads);
  const auto estimates = Drive(&odometry, [](int i, LidarScan* scan) {
    if (i == 0 || (i > 20 && i < 24)) scan->points.clear();
  });
  ASSERT_EQ(estimates.size(), static_cast<size_t>(kScans));
  EXPECT_EQ(estimates[22].leader, "guess");
  EXPECT_EQ(estimates.back().leader, "lidar");
  EXPECT_LT(WorstError(estimates), 0.2);
  EXPECT_THAT(odometry.Notices(),
              ElementsAre(HasSubstr("4 scans had no points"), HasSubstr("too few features")));
}

TEST(LegoLoam, PointsThatAreNoneAreLeftOutAndReported) {
  ThreadPool threads(2);
  LegoLoam odometry(LegoLoamOptions(), Rig(), &threads);
  const auto estimates = Drive(&odometry, [](int, LidarScan* scan) {
    for (size_t i = 0; i < scan->points.size(); i += 10) {
      scan->points[i].position.setConstant(std::numeric_limits<float>::quiet_NaN());
    }
  });
  EXPECT_LT(WorstError(estimates), 0.08);
  EXPECT_THAT(odometry.Notices(), ElementsAre(HasSubstr("points were not finite")));
}

TEST(LegoLoam, SwappedRingsAreOrderedAndReported) {
  ThreadPool threads(2);
  LegoLoam odometry(LegoLoamOptions(), Rig(), &threads);
  const auto estimates = Drive(&odometry, [](int, LidarScan* scan) {
    for (LidarPoint& point : scan->points) point.ring = static_cast<uint16_t>(15 - point.ring);
  });
  EXPECT_LT(WorstError(estimates), 0.06);
  EXPECT_THAT(odometry.Notices(), ElementsAre(HasSubstr("rings out of order")));
}

TEST(LegoLoam, MostPointsMayBeMissing) {
  ThreadPool threads(2);
  LegoLoam odometry(LegoLoamOptions(), Rig(), &threads);
  const auto estimates = Drive(&odometry, [](int i, LidarScan* scan) {
    if (i < 12 || i > 20) return;
    Random random(static_cast<uint64_t>(i));
    std::vector<LidarPoint> kept;
    for (const LidarPoint& point : scan->points) {
      if (random.Uniform() < 0.1) kept.push_back(point);
    }
    scan->points = kept;
  });
  ASSERT_EQ(estimates.size(), static_cast<size_t>(kScans));
  // Nine scans on a bend by constant velocity, and back on the map after them.
  EXPECT_LT(WorstError(estimates), 0.6);
  EXPECT_LT(WorstError({estimates.back()}), 0.1);
  EXPECT_THAT(odometry.Notices(), ElementsAre(HasSubstr("too few features")));
}

TEST(LegoLoam, ARepeatedScanHasNoPoseAndIsReported) {
  ThreadPool threads(2);
  LegoLoam odometry(LegoLoamOptions(), Rig(), &threads);
  EXPECT_EQ(odometry.AddScan(ScanAt(0)).size(), 1U);
  EXPECT_EQ(odometry.AddScan(ScanAt(0)).size(), 0U);
  EXPECT_EQ(odometry.AddScan(ScanAt(1)).size(), 1U);
  EXPECT_EQ(odometry.Refined()->size(), 2U);
  EXPECT_THAT(odometry.Notices(), ElementsAre(HasSubstr("no later than the one before")));
}

TEST(LegoLoam, OnePlaneIsSurvivedAndCalledDegenerate) {
  ThreadPool threads(2);
  LegoLoam odometry(LegoLoamOptions(), Rig(), &threads);
  TestLidar lidar;
  // Noise of a range would give the plane's points a relief that could be matched.
  lidar.sigma = 0.0;
  for (int i = 0; i < 10; ++i) {
    LidarScan scan = CastScan(
        lidar, [](const Eigen::Vector3d& point) { return point.z() + 1.5; }, 1, SE3());
    scan.stamp = FromSeconds(0.1 * i);
    const ScanEstimate estimate = odometry.AddScan(scan).front();
    EXPECT_LT(estimate.T_world_body.translation.norm(), 0.01);
    if (i == 0) continue;
    EXPECT_EQ(estimate.match.observable.degenerate_directions, 3);
    EXPECT_GT(estimate.covariance(3, 3), 0.05);
    EXPECT_LT(estimate.covariance(5, 5), 0.001);
  }
}

TEST(LegoLoam, SameBytesForAnyNumberOfThreads) {
  const auto last_pose = [](int count) {
    ThreadPool threads(count);
    LegoLoam odometry(LegoLoamOptions(), Rig(), &threads);
    return Drive(&odometry).back().T_world_body;
  };
  const SE3 one = last_pose(1);
  const SE3 three = last_pose(3);
  EXPECT_EQ(one.translation, three.translation);
  EXPECT_EQ(one.rotation.coeffs(), three.rotation.coeffs());
}

}  // namespace
}  // namespace regolith
