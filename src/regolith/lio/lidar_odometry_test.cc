// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/lidar_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "regolith/core/error.h"
#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr double kGravity = 1.62;
constexpr double kPi = 3.141592653589793;

double Ground(double x, double y) {
  return 0.5 * std::sin(0.5 * x) + 0.4 * std::cos(0.6 * y) + 0.1 * std::sin(1.7 * x + 1.1 * y);
}

/// Three seconds at rest, then a smooth start to 1 m/s on a wide curve, level, 1.2 m above the
/// origin's ground.
SE3 BodyAt(double t) {
  const double s = std::max(0.0, t - 3.0);
  const double way = s < 2.0 ? 0.25 * s * s : s - 1.0;
  const double angle = way / 20.0;
  return {ExpSo3({0.0, 0.0, angle}), {20.0 * std::sin(angle), 20.0 * (1.0 - std::cos(angle)), 0.0}};
}

ImuSample ImuAt(double t) {
  const double h = 1e-4;
  const Eigen::Vector3d acceleration =
      (BodyAt(t + h).translation - 2.0 * BodyAt(t).translation + BodyAt(t - h).translation) /
      (h * h);
  ImuSample sample;
  sample.time = FromSeconds(t);
  sample.angular_velocity =
      LogSo3(BodyAt(t - h).rotation.conjugate() * BodyAt(t + h).rotation) / (2.0 * h);
  sample.specific_force =
      BodyAt(t).rotation.conjugate() * (acceleration + Eigen::Vector3d(0, 0, kGravity));
  return sample;
}

/// Where the ray meets the ground, or walls 12 m off, by marching and bisection; infinite beyond
/// 40 m.
double Cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, bool walls) {
  const auto clearance = [&](double range) {
    const Eigen::Vector3d point = origin + range * direction;
    const double ground = point.z() + 1.7 - Ground(point.x(), point.y());
    if (!walls) return ground;
    return std::min({ground, 12.0 - std::abs(point.x()), 12.0 - std::abs(point.y())});
  };
  for (double range = 0.5; range < 40.0; range += 0.2) {
    if (clearance(range) > 0.0) continue;
    double low = range - 0.2;
    double high = range;
    for (int i = 0; i < 20; ++i)
      (clearance(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  }
  return INFINITY;
}

LidarScan MakeScan(double start, bool walls) {
  Random random(static_cast<uint64_t>(start * 10.0 + 0.5));
  LidarScan scan;
  scan.stamp = FromSeconds(start);
  for (int firing = 0; firing < 450; ++firing) {
    const double time = 0.1 * firing / 450.0;
    const SE3 pose = BodyAt(start + time);
    for (int ring = 0; ring < 16; ++ring) {
      const double azimuth = 2.0 * kPi * firing / 450.0;
      const double elevation = (-15.0 + 2.0 * ring) * kPi / 180.0;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double range = Cast(pose.translation, pose.rotation * direction, walls);
      if (!std::isfinite(range)) continue;
      LidarPoint point;
      point.position = ((range + random.Gaussian(0.0, 0.01)) * direction).cast<float>();
      point.time = static_cast<float>(time);
      point.ring = static_cast<uint16_t>(ring);
      scan.points.push_back(point);
    }
  }
  return scan;
}

/// Scans are shared by the tests, since casting them costs more than matching them.
const LidarScan& ScanAt(int index, bool walls) {
  static std::map<std::pair<int, bool>, LidarScan> scans;
  auto& scan = scans[{index, walls}];
  if (scan.points.empty()) scan = MakeScan(0.1 * index, walls);
  return scan;
}

RigCalibration Rig(bool with_imu) {
  RigCalibration rig;
  rig.gravity = kGravity;
  if (with_imu) rig.imu.emplace();
  rig.lidar.emplace();
  return rig;
}

RigCalibration RigWithWheels() {
  RigCalibration rig = Rig(true);
  rig.wheels.emplace();
  return rig;
}

void Append(std::vector<ScanEstimate> more, std::vector<ScanEstimate>* estimates) {
  for (ScanEstimate& estimate : more) estimates->push_back(std::move(estimate));
}

std::vector<ScanEstimate> Drive(LidarOdometry& odometry, double seconds, bool walls = false,
                                double imu_from = 0.0, double imu_gap_from = 1e9,
                                double imu_gap_to = 1e9) {
  std::vector<ScanEstimate> estimates;
  for (int i = 0; i * 0.005 < seconds; ++i) {
    const double t = i * 0.005;
    if (t >= imu_from && !(t > imu_gap_from && t < imu_gap_to))
      Append(odometry.AddImu(ImuAt(t)), &estimates);
    if (i % 20 == 0) Append(odometry.AddScan(ScanAt(i / 20, walls)), &estimates);
  }
  Append(odometry.Finish(), &estimates);
  return estimates;
}

double WorstError(const std::vector<ScanEstimate>& estimates) {
  double worst = 0.0;
  for (const ScanEstimate& estimate : estimates) {
    const SE3 truth = BodyAt(ToSeconds(estimate.stamp));
    worst = std::max(worst, (truth.translation - estimate.T_world_body.translation).norm());
  }
  return worst;
}

TEST(LidarOdometry, FollowsADriveWithAnImu) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  const auto estimates = Drive(odometry, 10.0);
  ASSERT_EQ(estimates.size(), 100U);
  EXPECT_LT(WorstError(estimates), 0.10);
  EXPECT_TRUE(estimates[15].at_rest);
  EXPECT_FALSE(estimates.back().at_rest);
  EXPECT_EQ(estimates.back().leader, "lidar+imu");
  EXPECT_TRUE(odometry.Notices().empty());
}

TEST(LidarOdometry, VelocitiesThatCannotBeAreLeftOutAndItSaysSo) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  const auto tell = [&](double time, double forward) {
    odometry.AddVelocity({FromSeconds(time), {forward, 0.0, 0.0}, 0.05});
  };
  // Sure of 3 m/s forwards, then of as much backwards: both are far from the drive's speed.
  for (int i = 0; i < 20; ++i) tell(5.0 + 0.1 * i, i < 10 ? 3.0 : -3.0);
  const auto estimates = Drive(odometry, 10.0);
  EXPECT_LT(WorstError(estimates), 0.10);
  ASSERT_EQ(odometry.Notices().size(), 1U);
  EXPECT_NE(odometry.Notices()[0].find("20 velocities"), std::string::npos)
      << odometry.Notices()[0];
}

TEST(LidarOdometry, AfterAVelocityThatCannotBeTheOthersWaitFiveSeconds) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  odometry.AddVelocity({FromSeconds(4.0), {3.0, 0.0, 0.0}, 0.05});
  // Sure of nothing, so that they can be: the first lies within the five seconds.
  odometry.AddVelocity({FromSeconds(8.9), {0.0, 0.0, 0.0}, 10.0});
  odometry.AddVelocity({FromSeconds(9.1), {0.0, 0.0, 0.0}, 10.0});
  Drive(odometry, 10.0);
  ASSERT_EQ(odometry.Notices().size(), 1U);
  EXPECT_EQ(odometry.Notices()[0].find("2 velocities"), 0U) << odometry.Notices()[0];
}

TEST(LidarOdometry, FollowsADriveWithoutAnImu) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(false), &threads);
  const auto estimates = Drive(odometry, 10.0, true);
  ASSERT_EQ(estimates.size(), 100U);
  EXPECT_LT(WorstError(estimates), 0.10);
}

TEST(LidarOdometry, FollowsADriveByEdgesAndPlanars) {
  ThreadPool threads(2);
  LidarOdometryOptions options;
  options.features = true;
  LidarOdometry odometry(options, Rig(true), &threads);
  const auto estimates = Drive(odometry, 10.0, true);
  ASSERT_EQ(estimates.size(), 100U);
  EXPECT_EQ(estimates.back().leader, "lidar+imu");
  EXPECT_LT(WorstError(estimates), 0.15);
}

TEST(LidarOdometry, BridgesAGapInTheImuAndSaysSo) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  const auto estimates = Drive(odometry, 10.0, false, 0.0, 6.0, 8.5);
  ASSERT_EQ(estimates.size(), 100U);
  EXPECT_LT(WorstError(estimates), 0.25);
  ASSERT_EQ(odometry.Notices().size(), 1U);
  EXPECT_NE(odometry.Notices()[0].find("gap"), std::string::npos);
}

TEST(LidarOdometry, ScansBeforeTheFirstImuSampleHaveNoPose) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  const auto estimates = Drive(odometry, 3.0, false, 1.5);
  EXPECT_NEAR(static_cast<double>(estimates.size()), 15.0, 1.0);
  ASSERT_FALSE(odometry.Notices().empty());
}

TEST(LidarOdometry, AnImuThatNeverComesIsGivenUp) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  std::vector<ScanEstimate> estimates;
  for (int i = 0; i < 50; ++i) Append(odometry.AddScan(ScanAt(i, true)), &estimates);
  ASSERT_EQ(estimates.size(), 50U);
  EXPECT_EQ(estimates.back().leader, "lidar");
  ASSERT_EQ(odometry.Notices().size(), 1U);
  EXPECT_NE(odometry.Notices()[0].find("silent"), std::string::npos) << odometry.Notices()[0];
}

TEST(LidarOdometry, AnImuThatComesLateIsTakenUpInMidDrive) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  const auto estimates = Drive(odometry, 10.0, true, 5.0);
  ASSERT_EQ(estimates.size(), 100U);
  EXPECT_EQ(estimates[48].leader, "lidar");
  EXPECT_FALSE(estimates[48].inertial.has_value());
  EXPECT_EQ(estimates[70].leader, "lidar+imu");
  EXPECT_LT(WorstError(estimates), 0.15);
  ASSERT_EQ(odometry.Notices().size(), 1U);
  EXPECT_NE(odometry.Notices()[0].find("first scans"), std::string::npos) << odometry.Notices()[0];
}

TEST(LidarOdometry, AnImuThatComesLateAndTooSlowlyIsLeftAsideAndSaid) {
  ThreadPool threads(1);
  LidarOdometry odometry({}, Rig(true), &threads);
  std::vector<ScanEstimate> estimates;
  for (int i = 0; i < 100; ++i) {
    if (i > 50) Append(odometry.AddImu(ImuAt(0.1 * i)), &estimates);
    Append(odometry.AddScan(ScanAt(i, true)), &estimates);
  }
  EXPECT_EQ(estimates.back().leader, "lidar");
  const std::vector<std::string> notices = odometry.Notices();
  ASSERT_EQ(notices.size(), 2U);
  EXPECT_NE(notices[0].find("not used"), std::string::npos) << notices[0];
  EXPECT_NE(notices[1].find("silent"), std::string::npos) << notices[1];
}

TEST(LidarOdometry, PosesAreGivenInATimeWithoutScans) {
  ThreadPool threads(1);
  LidarOdometry odometry({}, Rig(true), &threads);
  std::vector<ScanEstimate> estimates;
  for (int i = 0; i < 1000; ++i) {
    const double time = i * 0.005;
    Append(odometry.AddImu(ImuAt(time)), &estimates);
    if (i % 20 != 0) continue;
    if (i < 400 || i >= 600) {
      Append(odometry.AddScan(ScanAt(i / 20, true)), &estimates);
    } else {
      Append(odometry.AddStamp(FromSeconds(time)), &estimates);
    }
  }
  Append(odometry.Finish(), &estimates);
  ASSERT_EQ(estimates.size(), 50U);
  size_t asked = 0;
  for (const ScanEstimate& estimate : estimates) {
    asked += estimate.has_scan ? 0 : 1;
    const bool is_first = estimate.stamp == 0;  // there is no map yet
    EXPECT_EQ(estimate.leader, estimate.has_scan && !is_first ? "lidar+imu" : "imu");
  }
  EXPECT_EQ(asked, 10U);
  EXPECT_LT(WorstError(estimates), 0.15);
  EXPECT_TRUE(odometry.Notices().empty());
}

TEST(LidarOdometry, AfterALongTimeWithoutScansTheMapBeginsAnew) {
  ThreadPool threads(1);
  LidarOdometryOptions options;
  options.max_lost_sigma = 0.3;
  LidarOdometry odometry(options, Rig(true), &threads);
  std::vector<ScanEstimate> estimates;
  for (int i = 0; i < 2300; ++i) {
    const double time = i * 0.005;
    const bool is_blind = i >= 400 && i < 2000;
    ImuSample sample = ImuAt(time);
    if (is_blind) sample.specific_force.x() += 0.05;  // 1.6 m and 0.4 m/s in the end
    Append(odometry.AddImu(sample), &estimates);
    if (i % 20 != 0) continue;
    if (is_blind) {
      Append(odometry.AddStamp(FromSeconds(time)), &estimates);
    } else {
      Append(odometry.AddScan(ScanAt(i / 20, false)), &estimates);
    }
  }
  Append(odometry.Finish(), &estimates);
  ASSERT_EQ(estimates.size(), 115U);
  const auto error_of = [&](size_t from, size_t to) {
    const SE3 truth =
        BodyAt(ToSeconds(estimates[from].stamp)).Inverse() * BodyAt(ToSeconds(estimates[to].stamp));
    const SE3 motion = estimates[from].T_world_body.Inverse() * estimates[to].T_world_body;
    return (motion.translation - truth.translation).norm();
  };
  EXPECT_GT(error_of(19, 100), 1.0);
  EXPECT_LT(error_of(100, 103), 0.15);  // it does not jump,
  EXPECT_LT(error_of(105, 114), 0.05);  // and goes on well.
  // The doubt of the blind way stays, and is one of the place.
  const Matrix6d& covariance = estimates.back().covariance;
  EXPECT_GT(covariance.diagonal().tail<3>().sum(), 0.3 * 0.3);
  EXPECT_LT(covariance.diagonal().head<3>().sum(), 0.05 * 0.05);
  ASSERT_EQ(odometry.Notices().size(), 1U);
  EXPECT_NE(odometry.Notices()[0].find("begins anew"), std::string::npos);
}

TEST(LidarOdometry, RingsThatAreWrongAreSaid) {
  ThreadPool threads(1);
  LidarOdometry odometry({}, Rig(true), &threads);
  for (int i = 0; i < 300; ++i) {
    odometry.AddImu(ImuAt(i * 0.005));
    if (i % 20 != 0) continue;
    LidarScan scan = ScanAt(i / 20, false);
    for (LidarPoint& point : scan.points) point.ring = 0;
    odometry.AddScan(scan);
  }
  odometry.Finish();
  ASSERT_FALSE(odometry.Notices().empty());
  EXPECT_NE(odometry.Notices()[0].find("jumps of the range"), std::string::npos);
}

TEST(LidarOdometry, WithoutImuAndWheelsNoPoseIsInvented) {
  ThreadPool threads(1);
  LidarOdometry odometry({}, Rig(false), &threads);
  ASSERT_EQ(odometry.AddScan(ScanAt(0, true)).size(), 1U);
  EXPECT_TRUE(odometry.AddStamp(FromSeconds(0.1)).empty());
  EXPECT_EQ(odometry.AddScan(ScanAt(2, true)).size(), 1U);
}

TEST(LidarOdometry, EmptyScansAreBridgedByTheImu) {
  ThreadPool threads(1);
  LidarOdometry odometry({}, Rig(true), &threads);
  std::vector<ScanEstimate> estimates;
  for (int i = 0; i < 500; ++i) {
    odometry.AddImu(ImuAt(i * 0.005));
    if (i % 20 != 0) continue;
    LidarScan scan;
    scan.stamp = FromSeconds(i * 0.005);
    Append(odometry.AddScan(scan), &estimates);
  }
  Append(odometry.Finish(), &estimates);
  ASSERT_FALSE(estimates.empty());
  EXPECT_EQ(estimates.back().leader, "imu");
  EXPECT_LT(WorstError(estimates), 0.05);
}

TEST(LidarOdometry, ASlowImuIsReportedAndNotUsed) {
  ThreadPool threads(1);
  LidarOdometry odometry({}, Rig(true), &threads);
  size_t estimates = 0;
  for (int i = 0; i < 20; ++i) {
    for (const auto& made : {odometry.AddImu(ImuAt(0.1 * i)), odometry.AddScan(ScanAt(i, true))}) {
      estimates += made.size();
      for (const ScanEstimate& estimate : made) EXPECT_NE(estimate.leader, "lidar+imu");
    }
  }
  EXPECT_EQ(estimates, 20U);
  ASSERT_EQ(odometry.Notices().size(), 1U);
  EXPECT_NE(odometry.Notices()[0].find("10 Hz"), std::string::npos) << odometry.Notices()[0];
}

TEST(LidarOdometry, WithoutTheLidarASlowImuIsRefused) {
  ThreadPool threads(1);
  LidarOdometryOptions options;
  options.lidar = false;
  LidarOdometry odometry(options, Rig(true), &threads);
  const auto feed = [&] {
    for (int i = 0; i < 20; ++i) odometry.AddImu(ImuAt(0.1 * i));
  };
  EXPECT_THROW(feed(), InputError);
}

TEST(LidarOdometry, SamplesInUnitsOfGAreRefused) {
  ThreadPool threads(1);
  LidarOdometry odometry({}, Rig(true), &threads);
  const auto feed = [&] {
    for (int i = 0; i < 300; ++i) {
      ImuSample sample = ImuAt(i * 0.005);
      sample.specific_force /= 9.81;
      odometry.AddImu(sample);
    }
  };
  EXPECT_THROW(feed(), InputError);
}

/// Feeds IMU and scans that were tampered with; the wheels tell the truth but for `slip`.
std::vector<ScanEstimate> DriveWith(LidarOdometry& odometry, double seconds,
                                    const std::function<void(int, LidarScan*)>& tamper,
                                    double slip = 0.0) {
  std::vector<ScanEstimate> estimates;
  for (int i = 0; i * 0.005 < seconds; ++i) {
    const double t = i * 0.005;
    Append(odometry.AddImu(ImuAt(t)), &estimates);
    if (i % 4 == 0) {
      const SE3 step = BodyAt(t - 1e-3).Inverse() * BodyAt(t + 1e-3);
      WheelOdometry wheels;
      wheels.time = FromSeconds(t);
      wheels.linear_velocity_base.x() = (1.0 + slip) * step.translation.x() / 2e-3;
      Append(odometry.AddWheels(wheels), &estimates);
    }
    if (i % 20 != 0) continue;
    LidarScan scan = ScanAt(i / 20, false);
    tamper(i / 20, &scan);
    Append(odometry.AddScan(scan), &estimates);
  }
  Append(odometry.Finish(), &estimates);
  return estimates;
}

TEST(LidarOdometry, SurvivesNinetyPercentDropOut) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  const auto estimates = DriveWith(odometry, 10.0, [](int index, LidarScan* scan) {
    if (index < 45 || index > 95) return;
    std::vector<LidarPoint> kept;
    for (size_t i = 0; i < scan->points.size(); i += 10) kept.push_back(scan->points[i]);
    scan->points = kept;
  });
  ASSERT_EQ(estimates.size(), 100U);
  EXPECT_LT(WorstError(estimates), 0.15);
}

TEST(LidarOdometry, SurvivesPointsThatAreNoNumbersAndSwappedRings) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  const auto estimates = DriveWith(odometry, 6.0, [](int, LidarScan* scan) {
    for (size_t i = 0; i < scan->points.size(); ++i) {
      LidarPoint& point = scan->points[i];
      point.ring = static_cast<uint16_t>(15 - point.ring);
      if (i % 17 == 0) point.position.setConstant(std::nanf(""));
      if (i % 19 == 0) point.position.x() = INFINITY;
    }
  });
  ASSERT_EQ(estimates.size(), 60U);
  EXPECT_LT(WorstError(estimates), 0.10);
  for (const ScanEstimate& estimate : estimates) {
    EXPECT_TRUE(estimate.covariance.allFinite());
    for (const MapPoint& point : estimate.points) ASSERT_TRUE(point.position.allFinite());
  }
  ASSERT_EQ(odometry.Notices().size(), 1U);
  EXPECT_NE(odometry.Notices()[0].find("not finite"), std::string::npos);
}

TEST(LidarOdometry, ScansThatComeTwiceAreLeftOutAndReported) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  size_t count = 0;
  for (int i = 0; i < 800; ++i) {
    count += odometry.AddImu(ImuAt(i * 0.005)).size();
    if (i % 20 != 0) continue;
    count += odometry.AddScan(ScanAt(i / 20, false)).size();
    if (i % 100 == 0) count += odometry.AddScan(ScanAt(i / 20, false)).size();
  }
  count += odometry.Finish().size();
  EXPECT_EQ(count, 40U);
  ASSERT_EQ(odometry.Notices().size(), 1U);
  EXPECT_NE(odometry.Notices()[0].find("8 scans were not later"), std::string::npos);
}

TEST(LidarOdometry, AWrongTimeOffsetCostsLittle) {
  ThreadPool threads(2);
  LidarOdometry odometry({}, Rig(true), &threads);
  const auto estimates = DriveWith(
      odometry, 8.0, [](int, LidarScan* scan) { scan->stamp = AddSeconds(scan->stamp, 0.02); });
  ASSERT_EQ(estimates.size(), 80U);
  // The pose is that of the lidar 0.02 s before the stamp, at up to 1 m/s.
  EXPECT_LT(WorstError(estimates), 0.10);
}

TEST(LidarOdometry, OnAPlaneItSaysWhatItDoesNotKnow) {
  ThreadPool threads(2);
  const auto flatten = [](int, LidarScan* scan) {
    // Level ground 1.7 m below the sensor, as far as the ring reaches it.
    Random random(static_cast<uint64_t>(scan->stamp));
    std::vector<LidarPoint> flat;
    for (LidarPoint point : scan->points) {
      const Eigen::Vector3f direction = point.position.normalized();
      if (direction.z() > -0.05F) continue;
      const double range = -1.7 / static_cast<double>(direction.z()) + random.Gaussian(0.0, 0.02);
      point.position = static_cast<float>(range) * direction;
      flat.push_back(point);
    }
    scan->points = flat;
  };
  LidarOdometry alone({}, Rig(true), &threads);
  size_t degenerate = 0;
  bool contained = true;
  const auto estimates = DriveWith(alone, 10.0, flatten);
  for (const ScanEstimate& estimate : estimates) {
    degenerate += estimate.match.observable.degenerate_directions > 0 ? 1 : 0;
    const Eigen::Vector3d error =
        estimate.T_world_body.translation - BodyAt(ToSeconds(estimate.stamp)).translation;
    for (int axis = 0; axis < 3; ++axis) {
      contained = contained && std::abs(error[axis]) <
                                   3.0 * std::sqrt(estimate.covariance(3 + axis, 3 + axis)) + 0.01;
    }
  }
  EXPECT_GE(degenerate, 90U);
  EXPECT_TRUE(contained);

  const RigCalibration rig = RigWithWheels();
  LidarOdometryOptions options;
  options.wheels = true;
  LidarOdometry with_wheels(options, rig, &threads);
  const double slip = 0.03;
  const auto helped = DriveWith(with_wheels, 10.0, flatten, slip);
  ASSERT_EQ(helped.size(), 100U);
  // 5.5 m of way; the wheels' error is theirs, nothing is added to it.
  EXPECT_LT(WorstError(helped), 1.1 * slip * 5.5);
}

TEST(LidarOdometry, TheLidarTeachesTheSlipOfTheWheels) {
  ThreadPool threads(2);
  const RigCalibration rig = RigWithWheels();
  LidarOdometryOptions options;
  options.wheels = true;
  LidarOdometry odometry(options, rig, &threads);
  // The lidar is lost for the last two seconds.
  const auto blind = [](int index, LidarScan* scan) {
    if (index >= 80) scan->points.clear();
  };
  const auto estimates = DriveWith(odometry, 10.0, blind, 0.1);
  ASSERT_EQ(estimates.size(), 100U);
  EXPECT_EQ(estimates.back().leader, "wheels+imu");
  // Wheels that were believed would be 0.2 m too far after them.
  EXPECT_LT(WorstError(estimates), 0.10);
}

TEST(LidarOdometry, WheelsCountLessWhereTheLidarPlaces) {
  ThreadPool threads(2);
  const RigCalibration rig = RigWithWheels();
  LidarOdometryOptions options;
  options.wheels = true;
  options.filter.wheels.placed_inflation = 1.0;
  const auto whole = [](int, LidarScan*) {};
  // Wheels that say that the rover stands, more than slip can explain.
  LidarOdometry as_ever(options, rig, &threads);
  const double error_as_ever = WorstError(DriveWith(as_ever, 8.0, whole, -1.0));
  options.filter.wheels.placed_inflation = 3.0;
  LidarOdometry less(options, rig, &threads);
  EXPECT_LT(WorstError(DriveWith(less, 8.0, whole, -1.0)), 0.9 * error_as_ever);
}

TEST(LidarOdometry, WheelsAreTheGuessWithoutAnImu) {
  ThreadPool threads(2);
  RigCalibration rig = Rig(false);
  rig.wheels.emplace();
  LidarOdometryOptions options;
  options.wheels = true;
  LidarOdometry odometry(options, rig, &threads);
  std::vector<ScanEstimate> estimates;
  for (int i = 0; i < 500; ++i) {
    WheelOdometry wheels;
    wheels.time = FromSeconds(i * 0.02);
    wheels.T_odom_base = BodyAt(i * 0.02);
    Append(odometry.AddWheels(wheels), &estimates);
    if (i % 5 != 0) continue;
    LidarScan scan = ScanAt(i / 5, true);
    // For half a second there is nothing but the wheels.
    if (i > 300 && i < 325) scan.points.clear();
    Append(odometry.AddScan(scan), &estimates);
  }
  Append(odometry.Finish(), &estimates);
  ASSERT_EQ(estimates.size(), 100U);
  EXPECT_LT(WorstError(estimates), 0.10);
}

TEST(LidarOdometry, SameBytesForAnyNumberOfThreads) {
  const auto last_pose = [](int count) {
    ThreadPool threads(count);
    LidarOdometry odometry({}, Rig(true), &threads);
    return Drive(odometry, 4.0).back().T_world_body;
  };
  const SE3 one = last_pose(1);
  const SE3 three = last_pose(3);
  EXPECT_EQ(one.translation, three.translation);
  EXPECT_EQ(one.rotation.coeffs(), three.rotation.coeffs());
}

}  // namespace
}  // namespace regolith
