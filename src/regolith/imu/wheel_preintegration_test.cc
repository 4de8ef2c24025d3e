// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/imu/wheel_preintegration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

/// 0.5 m/s and 0.2 rad/s from an arbitrary pose, 50 Hz.
SE3 ArcPose(double time) {
  const double angle = 0.2 * time;
  const SE3 start(ExpSo3({0.0, 0.0, 0.9}), {5.0, -3.0, 0.0});
  return start *
         SE3(ExpSo3({0.0, 0.0, angle}), {2.5 * std::sin(angle), 2.5 - 2.5 * std::cos(angle), 0.0});
}

std::vector<WheelOdometry> Arc(double duration) {
  std::vector<WheelOdometry> odometry;
  for (int i = 0; i <= static_cast<int>(std::lround(duration * 50.0)); ++i) {
    WheelOdometry entry;
    entry.time = FromSeconds(i * 0.02);
    entry.T_odom_base = ArcPose(i * 0.02);
    odometry.push_back(entry);
  }
  return odometry;
}

TEST(WheelPreintegration, GivesTheArcBetweenAnyTwoTimes) {
  const std::vector<WheelOdometry> odometry = Arc(4.0);
  const auto delta = PreintegrateWheels(odometry, FromSeconds(0.513), FromSeconds(3.257), {});
  ASSERT_TRUE(delta.has_value());
  const SE3 expected = ArcPose(0.513).Inverse() * ArcPose(3.257);
  EXPECT_LT(Minus(delta->T_from_to, expected).norm(), 1e-4);
  EXPECT_NEAR(delta->distance, 0.5 * (3.257 - 0.513), 1e-5);
  EXPECT_NEAR(delta->angle, 0.2 * (3.257 - 0.513), 1e-9);
}

TEST(WheelPreintegration, UncertaintyGrowsWithDistanceAndLiesAlongTheTrack) {
  std::vector<WheelOdometry> odometry;
  for (int i = 0; i <= 100; ++i) {
    WheelOdometry entry;
    entry.time = i;
    entry.T_odom_base.translation = {0.02 * i, 0.0, 0.0};
    odometry.push_back(entry);
  }
  WheelPreintegrationOptions options;
  const auto near = PreintegrateWheels(odometry, 0, 50, options);
  const auto far = PreintegrateWheels(odometry, 0, 100, options);
  const double floor = options.floor_position_sigma;
  EXPECT_NEAR(std::sqrt(near->covariance(3, 3)) - floor, options.distance_sigma_share, 1e-9);
  EXPECT_NEAR(std::sqrt(far->covariance(3, 3)) - floor, 2.0 * options.distance_sigma_share, 1e-9);
  EXPECT_GT(near->covariance(5, 5), near->covariance(3, 3));
  EXPECT_GT(near->covariance(3, 3), near->covariance(4, 4));
}

TEST(WheelPreintegration, RefusesTimesOutsideTheSeries) {
  const std::vector<WheelOdometry> odometry = Arc(1.0);
  EXPECT_FALSE(PreintegrateWheels(odometry, -1, FromSeconds(0.5), {}).has_value());
  EXPECT_FALSE(PreintegrateWheels(odometry, 0, FromSeconds(1.5), {}).has_value());
  EXPECT_FALSE(PreintegrateWheels({}, 0, 1, {}).has_value());
  EXPECT_THROW(PreintegrateWheels(odometry, 5, 5, {}), CheckError);
}

}  // namespace
}  // namespace regolith
