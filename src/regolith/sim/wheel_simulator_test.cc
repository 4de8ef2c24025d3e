// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/wheel_simulator.h"

#include <cmath>

#include <gtest/gtest.h>

#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;

WheelOptions Exact() {
  WheelOptions options;
  options.slip_spread = 0.0;
  options.radius_error = 0.0;
  options.turn_error = 0.0;
  return options;
}

// The motion of the IMU when the base drives at `speed` m/s up a slope and turns.
MotionState Driving(double speed, double slope, double yaw_rate) {
  MotionState state;
  state.T_world_imu.rotation = Eigen::AngleAxisd(-slope, Eigen::Vector3d::UnitY());
  state.angular_velocity_imu = Eigen::Vector3d(0.0, 0.0, yaw_rate);
  state.v_world_imu =
      state.T_world_imu.rotation * (Eigen::Vector3d(speed, 0.0, 0.0) +
                                    state.angular_velocity_imu.cross(BaseFromImu().translation));
  return state;
}

TEST(MeanSlip, FollowsTheTableUphillAndSkidsDownhill) {
  const WheelOptions options;
  EXPECT_DOUBLE_EQ(MeanSlip(options, 0.0), 0.025);
  EXPECT_NEAR(MeanSlip(options, 5.0 * kDegree), 0.05, 1e-12);
  EXPECT_NEAR(MeanSlip(options, 12.5 * kDegree), 0.225, 1e-12);
  EXPECT_NEAR(MeanSlip(options, 30.0 * kDegree), 0.35, 1e-12);
  EXPECT_LT(MeanSlip(options, -10.0 * kDegree), 0.0);
}

TEST(WheelSimulator, ReportsMoreThanItDrivesUphill) {
  WheelSimulator wheels(Exact(), 1);
  const WheelOdometry odometry = wheels.Measure(Driving(0.5, 10.0 * kDegree, 0.0));
  EXPECT_NEAR(odometry.linear_velocity_base.x(), 0.5 / 0.9, 1e-9);
}

TEST(WheelSimulator, SlipsByTheTableAtEachOfItsSlopes) {
  const double slips[] = {0.025, 0.05, 0.10, 0.35};
  for (int i = 0; i < 4; ++i) {
    WheelSimulator wheels(Exact(), 1);
    const double speed =
        wheels.Measure(Driving(0.5, 5.0 * i * kDegree, 0.0)).linear_velocity_base.x();
    EXPECT_NEAR(1.0 - 0.5 / speed, slips[i], 1e-9) << i;
  }
}

TEST(WheelSimulator, ItsRadiusIsOnePercentOff) {
  WheelOptions options = Exact();
  options.radius_error = 0.01;
  options.slip = {0.0, 0.0, 0.0, 0.0};
  WheelSimulator wheels(options, 1);
  const double speed = wheels.Measure(Driving(0.5, 0.0, 0.0)).linear_velocity_base.x();
  EXPECT_NEAR(std::abs(speed / 0.5 - 1.0), 0.01, 1e-9);
}

TEST(WheelSimulator, IsTenPercentOffInPointTurnsAndNotInStraightDriving) {
  WheelOptions options = Exact();
  options.turn_error = 0.10;
  WheelSimulator wheels(options, 1);
  const double turning = wheels.Measure(Driving(0.0, 0.0, 0.3)).angular_velocity_base.z();
  EXPECT_NEAR(std::abs(turning / 0.3 - 1.0), 0.10, 1e-9);
  const double driving = wheels.Measure(Driving(0.5, 0.0, 0.02)).angular_velocity_base.z();
  EXPECT_NEAR(driving, 0.02, 0.02 * 0.002);
}

TEST(WheelSimulator, SlipSpreadsByAThird) {
  WheelOptions options = Exact();
  options.slip_spread = 1.0 / 3.0;
  WheelSimulator wheels(options, 1);
  double sum = 0.0;
  double squares = 0.0;
  const int count = 100000;
  for (int i = 0; i < count; ++i) {
    const double slip =
        1.0 - 0.5 / wheels.Measure(Driving(0.5, 5.0 * kDegree, 0.0)).linear_velocity_base.x();
    sum += slip;
    squares += slip * slip;
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean, 0.05, 0.002);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.05 / 3.0, 0.002);
}

}  // namespace
}  // namespace regolith
