// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/deskew.h"

#include <gtest/gtest.h>

#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr TimeNs kStart = 1700000000000000000;

// 2 m/s forward while turning at 0.5 rad/s.
SE3 BodyAt(double seconds) {
  return {ExpSo3({0.0, 0.0, 0.5 * seconds}), {2.0 * seconds, 0.0, 0.0}};
}

TEST(Deskew, UndoesAKnownMotion) {
  const SE3 T_body_lidar(ExpSo3({0.0, 0.0, 1.0}), {0.2, 0.0, 0.5});
  std::vector<StampedPose> motion;
  for (int i = 0; i <= 20; ++i)
    motion.push_back({AddSeconds(kStart, 0.005 * i), BodyAt(0.005 * i)});
  const Eigen::Vector3d landmark(10.0, -3.0, 1.0);
  LidarScan scan;
  scan.stamp = kStart;
  for (int i = 0; i < 100; ++i) {
    LidarPoint point;
    point.time = 0.001F * static_cast<float>(i);
    const SE3 T_world_lidar = BodyAt(static_cast<double>(point.time)) * T_body_lidar;
    point.position = (T_world_lidar.Inverse() * landmark).cast<float>();
    scan.points.push_back(point);
  }
  const SE3 T_world_reference = BodyAt(0.1);
  const auto points = Deskew(scan, T_body_lidar, motion, T_world_reference);
  ASSERT_EQ(points.size(), 100U);
  for (const Eigen::Vector3d& point : points) {
    EXPECT_LT((T_world_reference * point - landmark).norm(), 1e-4);
  }
}

TEST(Deskew, TakesTheNearestPoseOutsideTheMotionAndAcceptsUnsortedTimes) {
  std::vector<StampedPose> motion = {{kStart, BodyAt(0.0)}, {AddSeconds(kStart, 0.1), BodyAt(0.1)}};
  LidarScan scan;
  scan.stamp = kStart;
  for (const float time : {0.2F, -0.1F, 0.05F}) {
    LidarPoint point;
    point.position = {1.0F, 0.0F, 0.0F};
    point.time = time;
    scan.points.push_back(point);
  }
  const auto points = Deskew(scan, SE3(), motion, SE3());
  EXPECT_LT((points[0] - BodyAt(0.1) * Eigen::Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_LT((points[1] - Eigen::Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_NEAR(points[2].x(), 1.1, 0.01);
}

TEST(Deskew, IntervalSpansTheFiringTimes) {
  LidarScan scan;
  scan.stamp = kStart;
  EXPECT_EQ(IntervalOf(scan).end, kStart);
  scan.points.resize(2);
  scan.points[0].time = 0.0625F;
  scan.points[1].time = -0.03125F;
  EXPECT_EQ(IntervalOf(scan).begin, kStart - 31250000);
  EXPECT_EQ(IntervalOf(scan).end, kStart + 62500000);
}

}  // namespace
}  // namespace regolith
