// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/motion_initialization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regolith/geometry/so3.h"
#include "regolith/vio/test_world_internal.h"

namespace regolith {
namespace {

constexpr double kStart = 1.0;   // s
constexpr double kWindow = 1.5;  // s

/// The frames of a window of 1.5 s, and the recording that they are from.
struct Window {
  TestRecording recording;
  std::vector<BearingFrame> frames;
};

Window MakeWindow(const TestMotion& motion, const TestSensors& sensors, uint64_t seed) {
  Window window{Record(motion, RoomLandmarks(seed), sensors, kStart + kWindow + 0.2, seed), {}};
  for (const VioFrame& frame : window.recording.frames) {
    if (ToSeconds(frame.stamp) < kStart - 0.01) continue;
    BearingFrame bearings{frame.stamp, {}};
    for (const TrackedFeature& feature : frame.features) {
      bearings.bearings.emplace_back(feature.id, feature.bearing);
    }
    window.frames.push_back(std::move(bearings));
  }
  return window;
}

std::optional<MotionStart> Initialize(const Window& window, const TestSensors& sensors) {
  return InitializeInMotion(window.frames, window.recording.imu, sensors.T_imu_camera,
                            sensors.gravity);
}

TestMotion Still() {
  return [](double) { return BodyCourse(); };
}

TEST(MotionInitialization, FindsTheGyrosBias) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    TestSensors sensors;
    sensors.pixel_sigma = 0.15;
    const Window window = MakeWindow(HandHeldMotion(-10.0), sensors, seed);
    const auto bias = EstimateGyroBias(window.frames, window.recording.imu, sensors.T_imu_camera);
    ASSERT_TRUE(bias.has_value());
    EXPECT_LT((*bias - window.recording.gyro_bias).norm(), 1e-3) << "seed " << seed;
  }
}

TEST(MotionInitialization, TheGyrosBiasNeedsNoParallax) {
  TestSensors sensors;
  const Window window = MakeWindow(Still(), sensors, 3);
  const auto bias = EstimateGyroBias(window.frames, window.recording.imu, sensors.T_imu_camera);
  ASSERT_TRUE(bias.has_value());
  EXPECT_LT((*bias - window.recording.gyro_bias).norm(), 1e-3);
}

TEST(MotionInitialization, FindsVelocityAndUp) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const TestSensors sensors;
    const TestMotion motion = HandHeldMotion(-10.0);
    const Window window = MakeWindow(motion, sensors, seed);
    const auto start = Initialize(window, sensors);
    ASSERT_TRUE(start.has_value()) << "seed " << seed;
    const TrueMotion truth = TrueMotionAt(motion, kStart);
    const Eigen::Vector3d velocity_imu =
        start->state.T_world_imu.rotation.conjugate() * start->state.v_world_imu;
    const Eigen::Vector3d true_velocity_imu =
        truth.T_world_imu.rotation.conjugate() * truth.v_world_imu;
    const Eigen::Vector3d up =
        start->state.T_world_imu.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d true_up =
        truth.T_world_imu.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    // The accelerometer's bias counts as none: 0.05 m/s² and more are 0.3° and more of tilt.
    EXPECT_LT((velocity_imu - true_velocity_imu).norm(), 0.2) << "seed " << seed;
    EXPECT_LT(std::acos(std::min(up.dot(true_up), 1.0)), 0.03) << "seed " << seed;
    EXPECT_LT(start->median_error, 3.0 * sensors.pixel_sigma / kTestFocal);
    EXPECT_EQ(start->state.T_world_imu.translation.norm(), 0.0);
    EXPECT_EQ(start->state.time, window.frames[0].time);
  }
}

TEST(MotionInitialization, RefusesRest) {
  // Bearings as noisy as those of a network: a solution finds parallax in their noise.
  for (const double gravity : {1.62, 9.81}) {
    TestSensors sensors;
    sensors.gravity = gravity;
    sensors.pixel_sigma = 0.7;
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      EXPECT_FALSE(Initialize(MakeWindow(Still(), sensors, seed), sensors).has_value());
    }
  }
}

TEST(MotionInitialization, RefusesTurningOnTheSpot) {
  TestSensors sensors;
  sensors.T_imu_camera.translation.setZero();
  const auto turning = [](double time) {
    BodyCourse course;
    course.yaw = Wave(time, 0.4, 0.25, 0.0);
    course.pitch = Wave(time, 0.2, 0.4, 1.0);
    return course;
  };
  EXPECT_FALSE(Initialize(MakeWindow(turning, sensors, 2), sensors).has_value());
}

TEST(MotionInitialization, RefusesTooFewTracks) {
  TestSensors sensors;
  sensors.max_features = 8;
  const Window window = MakeWindow(HandHeldMotion(-10.0), sensors, 2);
  EXPECT_FALSE(
      EstimateGyroBias(window.frames, window.recording.imu, sensors.T_imu_camera).has_value());
  EXPECT_FALSE(Initialize(window, sensors).has_value());
}

}  // namespace
}  // namespace regolith
