// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/imu_quality.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regolith {
namespace {

constexpr double kMoonGravity = 1.62;

ImuSample SampleAt(double time) {
  ImuSample sample;
  sample.time = FromSeconds(time);
  sample.angular_velocity = {0.01 * std::sin(37.0 * time), 0.02 * std::sin(11.0 * time), 0.0};
  sample.specific_force = {0.0, 0.1 * std::sin(23.0 * time), kMoonGravity};
  return sample;
}

bool IsDoubtful(const ImuQuality& quality, double start, double end) {
  return quality.IsDoubtful(FromSeconds(start), FromSeconds(end));
}

TEST(ImuQuality, AnImuThatRunsIsNotDoubtful) {
  ImuQuality quality(0.1, kMoonGravity);
  for (int i = 0; i < 400; ++i) quality.Add(SampleAt(0.005 * i));
  EXPECT_FALSE(IsDoubtful(quality, 0.0, 2.0));
  EXPECT_TRUE(quality.Notices().empty());
}

TEST(ImuQuality, FindsGapsAndForgetsThem) {
  ImuQuality quality(0.1, kMoonGravity);
  for (int i = 0; i < 400; ++i) {
    const double time = 0.005 * i;
    if (time < 0.7 || time > 1.2) quality.Add(SampleAt(time));
  }
  EXPECT_TRUE(IsDoubtful(quality, 0.9, 1.0));
  EXPECT_TRUE(IsDoubtful(quality, 0.5, 0.8));
  EXPECT_FALSE(IsDoubtful(quality, 0.0, 0.69));
  EXPECT_FALSE(IsDoubtful(quality, 1.21, 2.0));
  ASSERT_EQ(quality.Notices().size(), 1U);
  EXPECT_NE(quality.Notices()[0].find("1 gaps in the IMU, the longest 0.51 s"), std::string::npos)
      << quality.Notices()[0];
  quality.Forget(FromSeconds(1.5));
  EXPECT_FALSE(IsDoubtful(quality, 0.9, 1.0));
  EXPECT_EQ(quality.Notices().size(), 1U);
}

TEST(ImuQuality, FindsRatesAtTheEndOfTheRange) {
  ImuQuality quality(0.1, kMoonGravity);
  for (int i = 0; i < 400; ++i) {
    ImuSample sample = SampleAt(0.005 * i);
    sample.angular_velocity.z() = std::min(1.5 * std::sin(0.01 * i), 1.0);
    quality.Add(sample);
  }
  // The rate passes 1 rad/s at 0.365 s and comes back to it at 1.206 s.
  EXPECT_FALSE(IsDoubtful(quality, 0.0, 0.36));
  EXPECT_TRUE(IsDoubtful(quality, 0.5, 0.6));
  EXPECT_FALSE(IsDoubtful(quality, 1.21, 2.0));
  ASSERT_EQ(quality.Notices().size(), 1U);
  EXPECT_NE(quality.Notices()[0].find("end of its range 1 times"), std::string::npos);
}

TEST(ImuQuality, FindsForcesAtTheEndOfTheRange) {
  ImuQuality quality(0.1, kMoonGravity);
  for (int i = 0; i < 100; ++i) {
    ImuSample sample = SampleAt(0.005 * i);
    if (i > 50) sample.specific_force.x() = -4.0;
    quality.Add(sample);
  }
  EXPECT_TRUE(IsDoubtful(quality, 0.3, 0.4));
}

TEST(ImuQuality, AValueInTheMiddleOfTheRangeMayRepeat) {
  // Coarse steps at rest: gravity itself on one axis, and rates of 0.
  ImuQuality quality(0.1, kMoonGravity);
  for (int i = 0; i < 100; ++i) {
    ImuSample sample;
    sample.time = FromSeconds(0.005 * i);
    sample.specific_force = {0.0, 0.0, kMoonGravity};
    quality.Add(sample);
  }
  EXPECT_FALSE(IsDoubtful(quality, 0.0, 1.0));
  EXPECT_TRUE(quality.Notices().empty());
}

}  // namespace
}  // namespace regolith
