// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/absolute_pose.h"

#include <gtest/gtest.h>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

TEST(AbsolutePose, IsFoundAmongWrongBearings) {
  Random random(2);
  const SE3 truth(ExpSo3({0.1, -0.2, 0.05}), {0.4, -0.1, 0.3});
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> bearings;
  for (int i = 0; i < 100; ++i) {
    points.emplace_back(random.Uniform(-3, 3), random.Uniform(-1, 1), random.Uniform(3, 9));
    Eigen::Vector3d ray = truth * points.back();
    if (i % 3 == 0) ray = {random.Uniform(-1, 1), random.Uniform(-1, 1), 1.0};
    bearings.push_back(ray.normalized());
  }
  const auto pose = EstimateAbsolutePose(points, bearings, AbsolutePoseOptions());
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->T_camera_points.translation - truth.translation).norm(), 1e-4);
  EXPECT_LT(AngleBetween(pose->T_camera_points.rotation, truth.rotation), 1e-5);
  EXPECT_GE(pose->inliers.size(), 66U);
  for (const int inlier : pose->inliers) {
    const auto row = static_cast<size_t>(inlier);
    EXPECT_LT(AngleBetween(bearings[row], truth * points[row]), 0.01);
  }
}

TEST(AbsolutePose, TooFewThatAgreeAreNone) {
  Random random(3);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> bearings;
  for (int i = 0; i < 40; ++i) {
    points.emplace_back(random.Uniform(-3, 3), random.Uniform(-1, 1), random.Uniform(3, 9));
    bearings.push_back(
        Eigen::Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1), 1.0).normalized());
  }
  EXPECT_FALSE(EstimateAbsolutePose(points, bearings, AbsolutePoseOptions()));
  points.resize(5);
  bearings.resize(5);
  EXPECT_FALSE(EstimateAbsolutePose(points, bearings, AbsolutePoseOptions()));
}

}  // namespace
}  // namespace regolith
