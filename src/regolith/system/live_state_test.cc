// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/live_state.h"

#include <gtest/gtest.h>

namespace regolith {
namespace {

constexpr double kGravity = 1.62;

ImuSample Still(double seconds) {
  ImuSample sample;
  sample.time = FromSeconds(seconds);
  sample.specific_force = {0.0, 0.0, kGravity};
  return sample;
}

/// Driving along x at 0.5 m/s, `off` metres beside the truth.
InertialState At(double seconds, double off) {
  InertialState state;
  state.state.time = FromSeconds(seconds);
  state.state.T_world_imu.translation = {0.5 * seconds, off, 0.0};
  state.state.v_world_imu = {0.5, 0.0, 0.0};
  state.gravity_world = {0.0, 0.0, -kGravity};
  return state;
}

TEST(LiveState, FollowsTheImuFromTheLastCorrection) {
  LiveState live;
  for (int i = 0; i <= 40; ++i) live.AddImu(Still(0.005 * i));
  EXPECT_FALSE(live.state());
  live.Correct(At(0.1, 0.0));
  ASSERT_TRUE(live.state());
  EXPECT_EQ(live.state()->time, FromSeconds(0.2));
  EXPECT_NEAR(live.state()->T_world_imu.translation.x(), 0.1, 1e-9);
  live.AddImu(Still(0.205));
  EXPECT_NEAR(live.state()->T_world_imu.translation.x(), 0.1025, 1e-9);
}

TEST(LiveState, ACorrectionIsTakenWithoutAJump) {
  LiveState live;
  for (int i = 0; i <= 20; ++i) live.AddImu(Still(0.005 * i));
  live.Correct(At(0.05, 0.0));
  double last = live.state()->T_world_imu.translation.y();
  live.Correct(At(0.08, 0.1));
  double largest = std::abs(live.state()->T_world_imu.translation.y() - last);
  for (int i = 21; i <= 400; ++i) {
    live.AddImu(Still(0.005 * i));
    const double now = live.state()->T_world_imu.translation.y();
    largest = std::max(largest, std::abs(now - last));
    last = now;
  }
  EXPECT_LT(largest, 0.005);
  EXPECT_NEAR(last, 0.1, 1e-4);
}

TEST(LiveState, SamplesThatAreNotLaterAreLeftOut) {
  LiveState live;
  live.AddImu(Still(0.0));
  live.AddImu(Still(0.1));
  live.Correct(At(0.05, 0.0));
  live.AddImu(Still(0.1));
  live.AddImu(Still(0.06));
  EXPECT_EQ(live.state()->time, FromSeconds(0.1));
}

}  // namespace
}  // namespace regolith
