// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/wheel_way.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

const Eigen::Vector3d kBias(0.01, -0.02, 0.03);
constexpr double kSpeed = 0.5;  // m/s

/// Wheels at 50 Hz that go straight on as far as they know.
std::vector<WheelOdometry> StraightWheels(double duration) {
  std::vector<WheelOdometry> wheels;
  for (int i = 0; i <= std::lround(50.0 * duration); ++i) {
    WheelOdometry odometry;
    odometry.time = FromSeconds(0.02 * i);
    odometry.T_odom_base.translation.x() = kSpeed * 0.02 * i;
    wheels.push_back(odometry);
  }
  return wheels;
}

/// An IMU at 200 Hz that turns at a constant rate.
std::vector<ImuSample> Turning(const Eigen::Vector3d& rate, double start, double end) {
  std::vector<ImuSample> samples;
  for (int i = 0; i <= std::lround(200.0 * (end - start)); ++i) {
    ImuSample sample;
    sample.time = FromSeconds(start + 0.005 * i);
    sample.angular_velocity = rate + kBias;
    samples.push_back(sample);
  }
  return samples;
}

std::optional<WheelWay> Way(const std::vector<WheelOdometry>& wheels,
                            const std::vector<ImuSample>& samples,
                            const Eigen::Quaterniond& R_imu_base = Eigen::Quaterniond::Identity()) {
  return IntegrateWheelWay(wheels, samples, R_imu_base, kBias);
}

TEST(WheelWay, StraightOnIsTheWheelsWay) {
  // From and to times between those of the wheels.
  const auto way = Way(StraightWheels(2.0), Turning(Eigen::Vector3d::Zero(), 0.305, 1.715));
  ASSERT_TRUE(way.has_value());
  EXPECT_LT((way->way_base - Eigen::Vector3d(kSpeed * 1.41, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(way->length, kSpeed * 1.41, 1e-9);
  EXPECT_NEAR(way->angle, 0.0, 1e-9);
}

TEST(WheelWay, TurnsAreTheGyros) {
  constexpr double kRate = 0.4;  // rad/s
  constexpr double kEnd = 3.0;   // s
  const auto way = Way(StraightWheels(4.0), Turning({0.0, 0.0, kRate}, 0.0, kEnd));
  ASSERT_TRUE(way.has_value());
  const double radius = kSpeed / kRate;
  const Eigen::Vector3d arc(radius * std::sin(kRate * kEnd), radius * (1 - std::cos(kRate * kEnd)),
                            0.0);
  EXPECT_LT((way->way_base - arc).norm(), 1e-4);
  EXPECT_NEAR(way->length, kSpeed * kEnd, 1e-9);
  EXPECT_NEAR(way->angle, kRate * kEnd, 0.01);
}

TEST(WheelWay, TheImuMayBeMountedAnyhow) {
  const Eigen::Quaterniond R_imu_base = ExpSo3({0.8, -0.5, 1.1});
  const Eigen::Vector3d rate_base(0.0, 0.1, 0.3);
  const auto expected = Way(StraightWheels(2.0), Turning(rate_base, 0.0, 2.0));
  const auto way = Way(StraightWheels(2.0), Turning(R_imu_base * rate_base, 0.0, 2.0), R_imu_base);
  ASSERT_TRUE(expected.has_value());
  ASSERT_TRUE(way.has_value());
  EXPECT_LT((way->way_base - expected->way_base).norm(), 1e-9);
}

TEST(WheelWay, NothingWhereTheWheelsDoNotCoverTheTime) {
  const Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  EXPECT_FALSE(Way(StraightWheels(1.0), Turning(rate, 0.5, 1.5)).has_value());
  EXPECT_FALSE(Way({}, Turning(rate, 0.5, 1.5)).has_value());
  std::vector<WheelOdometry> late = StraightWheels(2.0);
  late.erase(late.begin(), late.begin() + 30);
  EXPECT_FALSE(Way(late, Turning(rate, 0.5, 1.5)).has_value());
  EXPECT_FALSE(Way(StraightWheels(2.0), {}).has_value());
}

}  // namespace
}  // namespace regolith
