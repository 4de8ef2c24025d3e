// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/imu/rest_detection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr double kRate = 200.0;
const Eigen::Vector3d kGyroBias(0.006, -0.004, 0.01);

/// One second of an IMU of the default noise in an attitude, with vibration (share of gravity).
std::vector<ImuSample> Window(const Eigen::Quaterniond& rotation_world_imu, double gravity,
                              double vibration_share) {
  Random random(8);
  std::vector<ImuSample> samples;
  for (int i = 0; i < 200; ++i) {
    ImuSample sample;
    sample.time = FromSeconds(i / kRate);
    sample.angular_velocity = kGyroBias;
    sample.specific_force = rotation_world_imu.conjugate() * Eigen::Vector3d(0, 0, gravity);
    for (int axis = 0; axis < 3; ++axis) {
      sample.angular_velocity[axis] += random.Gaussian(0.0, 1.7e-4 * std::sqrt(kRate));
      sample.specific_force[axis] +=
          random.Gaussian(0.0, 2e-3 * std::sqrt(kRate) + vibration_share * gravity);
    }
    samples.push_back(sample);
  }
  return samples;
}

TEST(RestDetection, FindsRestOnEveryPlanetAndMotionByItsVibration) {
  for (const double gravity : {1.62, 3.72, 9.81}) {
    const Eigen::Quaterniond level = Eigen::Quaterniond::Identity();
    const std::vector<ImuSample> still = Window(level, gravity, 0.0);
    const RestReport rest = DetectRest(still, gravity, {});
    EXPECT_TRUE(rest.at_rest) << rest.reason;
    const std::vector<ImuSample> shaken = Window(level, gravity, 0.1);
    const RestReport drive = DetectRest(shaken, gravity, {});
    EXPECT_FALSE(drive.at_rest);
    EXPECT_NE(drive.reason.find("specific force"), std::string::npos);
  }
}

TEST(RestDetection, RefusesTurningShortWindowsUnitsOfGAndNan) {
  std::vector<ImuSample> samples = Window(Eigen::Quaterniond::Identity(), 1.62, 0.0);
  EXPECT_FALSE(DetectRest(Span<const ImuSample>(samples).Subspan(0, 50), 1.62, {}).at_rest);
  EXPECT_FALSE(DetectRest({}, 1.62, {}).at_rest);

  std::vector<ImuSample> turning = samples;
  for (ImuSample& sample : turning) sample.angular_velocity.z() += 0.1;
  EXPECT_FALSE(DetectRest(turning, 1.62, {}).at_rest);

  std::vector<ImuSample> units_of_g = samples;
  for (ImuSample& sample : units_of_g) sample.specific_force /= 1.62;
  const RestReport report = DetectRest(units_of_g, 1.62, {});
  EXPECT_FALSE(report.at_rest);
  EXPECT_NEAR(report.statistics.mean_specific_force.norm(), 1.0, 0.01);

  samples[20].specific_force.x() = std::nan("");
  EXPECT_FALSE(DetectRest(samples, 1.62, {}).at_rest);
}

TEST(InitializeAtRest, RecoversTiltWithoutYawAndTheGyroBias) {
  const Eigen::Quaterniond tilt = ExpSo3({0.0, 0.2, 0.0}) * ExpSo3({-0.3, 0.0, 0.0});
  const std::vector<ImuSample> samples = Window(tilt, 3.72, 0.0);
  const RestState state = InitializeAtRest(ComputeImuStatistics(samples));
  EXPECT_LT(AngleBetween(state.rotation_world_imu, tilt), 2e-3);
  EXPECT_LT((state.gyro_bias - kGyroBias).norm(), 1e-3);
  EXPECT_NEAR(state.specific_force_norm, 3.72, 0.01);
  EXPECT_NEAR(state.gyro_bias_sigma, 1.7e-4, 4e-5);
  EXPECT_NEAR(state.tilt_sigma, 2e-3 / 3.72, 2e-4);
}

TEST(RotationFromUp, StandsOnItsFeetInAnyAttitude) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d up(random.Gaussian(), random.Gaussian(), random.Gaussian());
    const Eigen::Quaterniond rotation = RotationFromUp(up);
    EXPECT_LT((rotation * up.normalized() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    const Eigen::Vector3d heading = rotation * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(heading.y(), 0.0, 1e-12);
    EXPECT_GE(heading.x(), 0.0);
  }
  for (const double sign : {-1.0, 1.0}) {
    const Eigen::Vector3d up = sign * Eigen::Vector3d::UnitX();
    const Eigen::Quaterniond rotation = RotationFromUp(up);
    EXPECT_LT((rotation * up - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_LT((rotation * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace regolith
