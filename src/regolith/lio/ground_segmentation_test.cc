// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/ground_segmentation.h"

#include <gtest/gtest.h>

#include "regolith/geometry/so3.h"
#include "regolith/lio/test_scene_internal.h"

namespace regolith {
namespace {

struct Rates {
  double found = 0.0;         ///< share of the ground's points that are labelled so
  double false_ground = 0.0;  ///< share of the other points that are
};

/// `clearance` (m) of a true ground point is below 5 cm.
Rates Score(const LidarScan& scan, const SE3& T_world_lidar, const TestScene& ground) {
  const PointLabels labels = SegmentGround(scan, MakeRingImage(scan, 16), Eigen::Vector3d::UnitZ(),
                                           GroundSegmentationOptions());
  double counts[2][2] = {};
  for (size_t i = 0; i < scan.points.size(); ++i) {
    const bool is_ground = ground(T_world_lidar * scan.points[i].position.cast<double>()) < 0.05;
    counts[is_ground ? 1 : 0][labels[i] == PointLabel::kGround ? 1 : 0] += 1.0;
  }
  return {counts[1][1] / std::max(1.0, counts[1][0] + counts[1][1]),
          counts[0][1] / std::max(1.0, counts[0][0] + counts[0][1])};
}

Rates ScoreScene(const SE3& T_world_lidar, const TestScene& ground, const TestScene& things) {
  TestLidar lidar;
  lidar.columns = 900;
  const TestScene scene = [&](const Eigen::Vector3d& point) {
    return std::min(ground(point), things(point));
  };
  return Score(CastScan(lidar, scene, 5, T_world_lidar), T_world_lidar, ground);
}

double Nothing(const Eigen::Vector3d&) { return 100.0; }
double Flat(const Eigen::Vector3d& point) { return point.z(); }

/// A rover 1.2 m above the ground, pitched and rolled by what the body does on rocks.
SE3 Tilted(double roll_deg, double pitch_deg, double height) {
  return {ExpSo3(Eigen::Vector3d(roll_deg, pitch_deg, 0.0) * kTestPi / 180.0), {0, 0, height}};
}

TEST(GroundSegmentation, FindsAPlainWithWallsAndRocksOnIt) {
  const auto things = [](const Eigen::Vector3d& point) {
    return std::min({12.0 - std::abs(point.x()), ToBox(point, {5, 1, 0}, {0.4, 0.4, 0.5}),
                     (point - Eigen::Vector3d(-4.5, 0, 0)).norm() - 0.6,
                     (point - Eigen::Vector3d(0, 6, 0)).norm() - 0.5});
  };
  const Rates rates = ScoreScene(Tilted(0, 0, 1.2), Flat, things);
  EXPECT_GT(rates.found, 0.95);
  EXPECT_LT(rates.false_ground, 0.1);
}

TEST(GroundSegmentation, DoesNotNeedARoverThatStandsLevel) {
  const auto wall = [](const Eigen::Vector3d& point) { return 12.0 - std::abs(point.x()); };
  for (const double tilt : {-12.0, 12.0}) {
    const Rates rates = ScoreScene(Tilted(tilt, 0.5 * tilt, 1.2), Flat, wall);
    EXPECT_GT(rates.found, 0.9) << tilt;
    EXPECT_LT(rates.false_ground, 0.08) << tilt;
  }
}

TEST(GroundSegmentation, FollowsASlopeOntoWhichTheRoverLooks) {
  // 25° from 6 m ahead on: level ground's test would end there.
  const double tangent = std::tan(25.0 * kTestPi / 180.0);
  const auto slope = [&](const Eigen::Vector3d& point) {
    // The foot of the slope is rounded over 4 m.
    const double in = std::clamp(point.x() - 6.0, 0.0, 4.0);
    const double height = tangent * (in * in / 8.0 + std::max(0.0, point.x() - 10.0));
    return 0.9 * (point.z() - height);
  };
  const auto pillar = [](const Eigen::Vector3d& point) {
    return ToBox(point, {10, 3, 2}, {0.5, 0.5, 3});
  };
  const Rates rates = ScoreScene(Tilted(0, 0, 1.2), slope, pillar);
  EXPECT_GT(rates.found, 0.9);
  EXPECT_LT(rates.false_ground, 0.1);
}

TEST(GroundSegmentation, FollowsACrater) {
  // A bowl 30 m wide and 4 m deep, the rover off its middle: slopes up to 28° all around.
  const auto bowl = [](const Eigen::Vector3d& point) {
    const double radius = std::min(std::hypot(point.x() - 4.0, point.y()), 15.0);
    return 0.85 * (point.z() - 4.0 * radius * radius / 225.0);
  };
  const Rates rates = ScoreScene(Tilted(0, -8, 1.5), bowl, Nothing);
  EXPECT_GT(rates.found, 0.9);
}

TEST(GroundSegmentation, LeavesTheWallsOfARoomAlone) {
  const auto walls = [](const Eigen::Vector3d& point) {
    return std::min(4.0 - std::abs(point.x()), 5.0 - std::abs(point.y()));
  };
  // The lowest ring meets the walls before the ground.
  const Rates rates = ScoreScene(Tilted(0, 0, 1.7), Flat, walls);
  EXPECT_LT(rates.false_ground, 0.02);
}

}  // namespace
}  // namespace regolith
