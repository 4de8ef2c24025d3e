// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/imu/propagation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

const Eigen::Vector3d kGravityWorld(0.0, 0.0, -1.62);

/// A circle of radius 2 m at 0.5 rad/s, heading along it, in lunar gravity.
NavState CircleState(double time) {
  const double angle = 0.5 * time;
  NavState state;
  state.time = FromSeconds(time);
  state.T_world_imu.rotation = ExpSo3({0.0, 0.0, angle});
  state.T_world_imu.translation = {2.0 * std::sin(angle), 2.0 - 2.0 * std::cos(angle), 0.0};
  state.v_world_imu = {std::cos(angle), std::sin(angle), 0.0};
  return state;
}

ImuSample CircleSample(double time) {
  return {FromSeconds(time), {0.0, 0.0, 0.5}, {0.0, 0.5, 1.62}};
}

TEST(Propagation, FollowsACircleWithBiasedSensors) {
  NavState state = CircleState(0.0);
  state.gyro_bias = {0.01, -0.02, 0.03};
  state.accelerometer_bias = {-0.2, 0.1, 0.05};
  for (int i = 0; i < 2000; ++i) {
    ImuSample from = CircleSample(0.005 * i);
    ImuSample to = CircleSample(0.005 * (i + 1));
    for (ImuSample* sample : {&from, &to}) {
      sample->angular_velocity += state.gyro_bias;
      sample->specific_force += state.accelerometer_bias;
    }
    state = Propagate(state, from, to, kGravityWorld);
  }
  const NavState truth = CircleState(10.0);
  EXPECT_EQ(state.time, truth.time);
  EXPECT_LT((state.T_world_imu.translation - truth.T_world_imu.translation).norm(), 1e-4);
  EXPECT_LT((state.v_world_imu - truth.v_world_imu).norm(), 1e-5);
  EXPECT_LT(AngleBetween(state.T_world_imu.rotation, truth.T_world_imu.rotation), 1e-10);
}

TEST(Propagation, RefusesTimeThatStandsStill) {
  EXPECT_THROW(Propagate(NavState(), CircleSample(1.0), CircleSample(1.0), kGravityWorld),
               CheckError);
}

TEST(SamplesBetween, CoversJustTheTimeAskedFor) {
  std::vector<ImuSample> samples;
  for (int i = 0; i <= 10; ++i) samples.push_back({i * 100, {1.0 * i, 0, 0}, {0, 0, 2.0 * i}});
  const std::vector<ImuSample> between = SamplesBetween(samples, 250, 500);
  ASSERT_EQ(between.size(), 4U);
  EXPECT_EQ(between[0].time, 250);
  EXPECT_DOUBLE_EQ(between[0].angular_velocity.x(), 2.5);
  EXPECT_DOUBLE_EQ(between[0].specific_force.z(), 5.0);
  EXPECT_EQ(between[1].time, 300);
  EXPECT_EQ(between[2].time, 400);
  EXPECT_EQ(between[3].time, 500);
  EXPECT_DOUBLE_EQ(between[3].angular_velocity.x(), 5.0);
}

TEST(SamplesBetween, HoldsTheNearestSampleBeyondItsEnds) {
  const std::vector<ImuSample> samples = {{100, {1, 0, 0}, {0, 0, 1}}, {200, {2, 0, 0}, {0, 0, 2}}};
  const std::vector<ImuSample> between = SamplesBetween(samples, 0, 300);
  ASSERT_EQ(between.size(), 4U);
  EXPECT_EQ(between.front().time, 0);
  EXPECT_EQ(between.front().angular_velocity.x(), 1.0);
  EXPECT_EQ(between.back().time, 300);
  EXPECT_EQ(between.back().angular_velocity.x(), 2.0);
  const std::vector<ImuSample> after = SamplesBetween(samples, 250, 300);
  ASSERT_EQ(after.size(), 2U);
  EXPECT_EQ(after.front().angular_velocity.x(), 2.0);
  EXPECT_TRUE(SamplesBetween({}, 0, 1).empty());
}

}  // namespace
}  // namespace regolith
