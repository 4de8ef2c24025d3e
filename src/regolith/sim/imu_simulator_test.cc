// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/imu_simulator.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;

ImuOptions Silent() {
  ImuOptions options;
  options.noise.gyro_density = 0.0;
  options.noise.accelerometer_density = 0.0;
  options.noise.gyro_walk = 0.0;
  options.noise.accelerometer_walk = 0.0;
  options.noise.gyro_bias_sigma = 0.0;
  options.noise.accelerometer_bias_sigma = 0.0;
  return options;
}

// Overlapping Allan variance from running sums of the samples (IEEE Std 952-1997, annex C).
double AllanVariance(const std::vector<double>& sums, size_t cluster) {
  double squares = 0.0;
  const size_t count = sums.size() - 2 * cluster;
  for (size_t i = 0; i < count; ++i) {
    const double change = sums[i + 2 * cluster] - 2.0 * sums[i + cluster] + sums[i];
    squares += change * change;
  }
  const auto size = static_cast<double>(cluster);
  return squares / (2.0 * size * size * static_cast<double>(count));
}

// Mean Allan variance of three axes over `seconds` s.
double AllanVariance(const std::array<std::vector<double>, 3>& axes, double seconds, double rate) {
  const auto cluster = static_cast<size_t>(std::lround(seconds * rate));
  double sum = 0.0;
  for (const std::vector<double>& sums : axes) sum += AllanVariance(sums, cluster);
  return sum / 3.0;
}

TEST(ExactImu, PointsUpAtRest) {
  const ImuSample sample = ExactImu(MotionState{}, 1.62);
  EXPECT_EQ(sample.specific_force, Eigen::Vector3d(0.0, 0.0, 1.62));
}

TEST(ImuSimulator, WhiteNoiseHasItsDensityAtItsRate) {
  ImuOptions options = Silent();
  options.noise.gyro_density = 1.7e-4;
  options.noise.accelerometer_density = 2e-3;
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
    ImuOptions options = Silent();
    options.noise.accelerometer_walk = 3e-3;
    ImuSimulator imu(options, 0.0, static_cast<uint64_t>(run));
    ImuSample last;
    for (int i = 0; i <= 400; ++i) last = imu.Measure(MotionState{});
    squares += last.specific_force.squaredNorm();
  }
  const double expected = 3e-3 * std::sqrt(2.0);  // after 400 samples at 200 Hz
  EXPECT_NEAR(std::sqrt(squares / (3 * runs)), expected, 0.1 * expected);
}

// σ²(τ) = N² / τ + K² τ / 3 (IEEE Std 952-1997, equations C.12 and C.17): far from where the two
// meet, each can be read off alone.
TEST(ImuSimulator, AllanDeviationAtRestShowsDensitiesAndWalks) {
  const ImuOptions options;
  ImuSimulator imu(options, 1.62, 5);
  std::array<std::vector<double>, 3> gyro;
  std::array<std::vector<double>, 3> accelerometer;
  const int hours = 3;
  const auto count = static_cast<int>(hours * 3600 * options.rate);
  Eigen::Vector3d turned = Eigen::Vector3d::Zero();
  Eigen::Vector3d pushed = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    const ImuSample sample = imu.Measure(MotionState{});
    turned += sample.angular_velocity;
    pushed += sample.specific_force;
    for (size_t axis = 0; axis < 3; ++axis) {
      gyro[axis].push_back(turned[static_cast<int>(axis)]);
      accelerometer[axis].push_back(pushed[static_cast<int>(axis)]);
    }
  }
  const auto density = [&](const auto& axes, double seconds) {
    return std::sqrt(AllanVariance(axes, seconds, options.rate) * seconds);
  };
  const auto walk = [&](const auto& axes, double seconds) {
    return std::sqrt(AllanVariance(axes, seconds, options.rate) * 3.0 / seconds);
  };
  EXPECT_NEAR(density(gyro, 0.5), 1.7e-4, 0.03 * 1.7e-4);
  EXPECT_NEAR(walk(gyro, 100.0), 2e-5, 0.1 * 2e-5);
  EXPECT_NEAR(density(accelerometer, 0.1), 2e-3, 0.03 * 2e-3);
  EXPECT_NEAR(walk(accelerometer, 20.0), 3e-3, 0.1 * 3e-3);
}

TEST(ImuSimulator, ScaleAndMisalignmentDistortWhatItMeasures) {
  ImuOptions options = Silent();
  options.gyro_scale_sigma = 0.01;
  options.accelerometer_misalignment_deg = 0.5;
  ImuSimulator imu(options, 1.62, 11);
  MotionState motion;
  motion.angular_velocity_imu = Eigen::Vector3d(0.1, -0.2, 0.3);
  const ImuSample sample = imu.Measure(motion);
  // The gyro's axes stay square, each with its own scale; the accelerometers lean.
  EXPECT_TRUE(imu.gyro_axes().isDiagonal());
  EXPECT_TRUE(sample.angular_velocity.isApprox(imu.gyro_axes() * motion.angular_velocity_imu));
  EXPECT_GT((sample.angular_velocity - motion.angular_velocity_imu).norm(), 1e-4);
  EXPECT_EQ(imu.accelerometer_axes().diagonal(), Eigen::Vector3d::Ones());
  EXPECT_TRUE(sample.specific_force.isApprox(imu.accelerometer_axes().col(2) * 1.62));
  EXPECT_GT(sample.specific_force.head<2>().norm(), 1e-3);
}

TEST(ImuSimulator, ScaleAndMisalignmentSpreadAsAskedFor) {
  ImuOptions options = Silent();
  options.gyro_scale_sigma = 0.003;
  options.accelerometer_scale_sigma = 0.002;
  options.gyro_misalignment_deg = 0.1;
  options.accelerometer_misalignment_deg = 0.2;
  const int runs = 1000;
  Eigen::Matrix3d gyro = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d accelerometer = gyro;
  for (int run = 0; run < runs; ++run) {
    const ImuSimulator imu(options, 1.62, static_cast<uint64_t>(run));
    gyro += (imu.gyro_axes() - Eigen::Matrix3d::Identity()).cwiseAbs2();
    accelerometer += (imu.accelerometer_axes() - Eigen::Matrix3d::Identity()).cwiseAbs2();
  }
  const auto expect = [&](const Eigen::Matrix3d& squares, double scale, double angle) {
    const Eigen::Matrix3d sigma = (squares / runs).cwiseSqrt();
    for (int i = 0; i < 9; ++i) {
      const double expected = i % 4 == 0 ? scale : angle * kDegree;
      EXPECT_NEAR(sigma(i), expected, 0.1 * expected) << i;
    }
  };
  expect(gyro, 0.003, 0.1);
  expect(accelerometer, 0.002, 0.2);
}

TEST(ImuSimulator, WithoutScaleAndMisalignmentItsAxesAreExact) {
  const ImuSimulator imu(ImuOptions{}, 1.62, 4);
  EXPECT_EQ(imu.gyro_axes(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(imu.accelerometer_axes(), Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace regolith
