// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/imu_simulator.h"

#include <cmath>

#include <gtest/gtest.h>

namespace regolith {
namespace {

TEST(ExactImu, PointsUpAtRest) {
  const ImuSample sample = ExactImu(MotionState{}, 1.62);
  EXPECT_EQ(sample.specific_force, Eigen::Vector3d(0.0, 0.0, 1.62));
}

TEST(ImuSimulator, WhiteNoiseHasItsDensityAtItsRate) {
  ImuOptions options;
  options.noise.gyro_walk = 0.0;
  options.noise.accelerometer_walk = 0.0;
  options.noise.gyro_bias_sigma = 0.0;
  options.noise.accelerometer_bias_sigma = 0.0;
  ImuSimulator imu(options, 1.62, 7);
  double gyro = 0.0;
  double accelerometer = 0.0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const ImuSample sample = imu.Measure(MotionState{});
    gyro += sample.angular_velocity.squaredNorm();
    accelerometer += (sample.specific_force - Eigen::Vector3d(0, 0, 1.62)).squaredNorm();
  }
  const double root_rate = std::sqrt(options.rate);
  EXPECT_NEAR(std::sqrt(gyro / (3 * count)), 1.7e-4 * root_rate, 0.02 * 1.7e-4 * root_rate);
  EXPECT_NEAR(std::sqrt(accelerometer / (3 * count)), 2e-3 * root_rate, 0.02 * 2e-3 * root_rate);
}

TEST(ImuSimulator, BiasesWalkWithTheRootOfTime) {
  double squares = 0.0;
  const int runs = 300;
  for (int run = 0; run < runs; ++run) {
    ImuOptions options;
    options.noise.accelerometer_density = 0.0;
    options.noise.accelerometer_bias_sigma = 0.0;
    ImuSimulator imu(options, 0.0, static_cast<uint64_t>(run));
    ImuSample last;
    for (int i = 0; i <= 400; ++i) last = imu.Measure(MotionState{});
    squares += last.specific_force.squaredNorm();
  }
  const double expected = 3e-3 * std::sqrt(2.0);  // after 400 samples at 200 Hz
  EXPECT_NEAR(std::sqrt(squares / (3 * runs)), expected, 0.1 * expected);
}

}  // namespace
}  // namespace regolith
