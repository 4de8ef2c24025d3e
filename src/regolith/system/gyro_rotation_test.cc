// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/gyro_rotation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr TimeNs kStart = 1700000000000000000;

TimeNs At(double seconds) { return AddSeconds(kStart, seconds); }

// About one axis, so that the angle is the integral of the rate.
constexpr double kAmplitude = 0.4;
double RateAt(double seconds) { return 2.0 * kAmplitude * std::cos(2.0 * seconds); }
double AngleAt(double seconds) { return kAmplitude * std::sin(2.0 * seconds); }
const Eigen::Vector3d kAxis = Eigen::Vector3d(0.6, 0.0, 0.8);
const Eigen::Vector3d kBias = Eigen::Vector3d(0.01, -0.02, 0.03);

ImuSample Sample(double seconds) {
  ImuSample sample;
  sample.time = At(seconds);
  sample.angular_velocity = RateAt(seconds) * kAxis + kBias;
  return sample;
}

TEST(GyroRotation, IntegratesBetweenAnyTimes) {
  GyroRotation gyro;
  gyro.SetBias(kBias);
  double last = 0.101;
  int sample = 0;
  for (int frame = 0; frame < 20; ++frame) {
    const double next = last + 0.0987;
    for (; sample * 0.005 <= next; ++sample) gyro.Add(Sample(sample * 0.005));
    const auto rotation = gyro.Between(At(last), At(next));
    ASSERT_TRUE(rotation.has_value());
    const Eigen::Quaterniond expected = ExpSo3(kAxis * (AngleAt(next) - AngleAt(last)));
    EXPECT_LT(AngleBetween(*rotation, expected), 3e-5);
    last = next;
  }
}

TEST(GyroRotation, SaysNothingAcrossGaps) {
  GyroRotation gyro;
  EXPECT_FALSE(gyro.Between(At(0.0), At(0.1)).has_value());
  for (int i = 0; i < 20; ++i) gyro.Add(Sample(0.005 * i));
  EXPECT_FALSE(gyro.Between(At(0.0), At(0.2)).has_value());
  for (int i = 40; i < 60; ++i) gyro.Add(Sample(0.005 * i));
  EXPECT_FALSE(gyro.Between(At(0.05), At(0.25)).has_value());
  EXPECT_TRUE(gyro.Between(At(0.21), At(0.3)).has_value());
  EXPECT_FALSE(gyro.Between(At(0.3), At(0.2)).has_value());
}

TEST(GyroRotation, LeavesOutSamplesThatComeLate) {
  GyroRotation gyro;
  gyro.Add(Sample(0.0));
  gyro.Add(Sample(0.005));
  ImuSample wrong = Sample(0.004);
  wrong.angular_velocity.setConstant(1e6);
  gyro.Add(wrong);
  const auto rotation = gyro.Between(At(0.0), At(0.005));
  ASSERT_TRUE(rotation.has_value());
  EXPECT_LT(AngleBetween(*rotation, Eigen::Quaterniond::Identity()), 0.01);
}

}  // namespace
}  // namespace regolith
