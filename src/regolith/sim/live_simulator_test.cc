// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/live_simulator.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "regolith/core/check.h"
#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

/// Level ground without rocks and a lidar of few beams: quick.
ScenarioOptions Plain() {
  ScenarioOptions options;
  options.MakeDraft();
  options.mesh.reach = 60.0;
  options.terrain.relief.slope_deg = 0.5;
  options.terrain.craters.density = 0.0;
  options.terrain.rocks.law = RockLaw::kNone;
  options.drive.wanted_slope_deg = 0.0;
  options.drive.length = 15.0;
  options.camera.width = 64;
  options.camera.height = 48;
  options.lidar.firings = 60;
  return options;
}

class LiveSimulatorTest : public testing::Test {
 protected:
  void Make(const ScenarioOptions& options, const std::string& camera = "") {
    simulator_ = LiveSimulator::Create(options, nullptr, camera, &pool_);
    start_ = simulator_->next_time();
  }

  /// Drives for `seconds`, and gives the base's pose then, from that at the start.
  SE3 Drive(double speed, double yaw_rate, double seconds) {
    simulator_->Command(speed, yaw_rate);
    const TimeNs begin = simulator_->next_time();
    const TimeNs end = AddSeconds(begin, seconds);
    const SE3 T_world_begin = simulator_->T_world_base(begin);
    while (simulator_->next_time() < end) simulator_->Next();
    return T_world_begin.Inverse() * simulator_->T_world_base(end);
  }

  static double Yaw(const SE3& pose) {
    const Eigen::Vector3d ahead = pose.rotation * Eigen::Vector3d::UnitX();
    return std::atan2(ahead.y(), ahead.x());
  }

  ThreadPool pool_{2};
  std::unique_ptr<LiveSimulator> simulator_;
  TimeNs start_ = 0;
};

TEST_F(LiveSimulatorTest, AllSensorsMeasureAtTheirRatesInOrderOfBeingThere) {
  Make(Plain(), "mono");
  int imu = 0;
  int wheels = 0;
  int scans = 0;
  int frames = 0;
  TimeNs last = 0;
  while (simulator_->next_time() < AddSeconds(start_, 2.0)) {
    const TimeNs due = simulator_->next_time();
    EXPECT_GE(due, last);
    last = due;
    const SensorEvent event = simulator_->Next();
    if (std::holds_alternative<LidarScan>(event)) {
      ++scans;
      EXPECT_EQ(EventTime(event), AddSeconds(due, -0.1));
      EXPECT_GT(std::get<LidarScan>(event).points.size(), 100U);
    } else {
      EXPECT_NEAR(SecondsBetween(due, EventTime(event)), 0.0, 0.005);
    }
    imu += std::holds_alternative<ImuSample>(event) ? 1 : 0;
    wheels += std::holds_alternative<WheelOdometry>(event) ? 1 : 0;
    frames += std::holds_alternative<CameraFrame>(event) ? 1 : 0;
  }
  EXPECT_EQ(imu, 400);
  EXPECT_EQ(wheels, 100);
  EXPECT_EQ(frames, 20);
  EXPECT_EQ(scans, 19);
  EXPECT_EQ(LiveSimulator::Rig(Plain(), "mono").cameras.size(), 1U);
}

TEST_F(LiveSimulatorTest, StandsUntilItIsToldThenFollowsAndStopsAtItsBorder) {
  ScenarioOptions options = Plain();
  options.lidar.rate = 2.0;
  Make(options);
  EXPECT_EQ(Drive(0.0, 0.0, 1.0).translation.norm(), 0.0);
  const SE3 straight = Drive(0.5, 0.0, 5.0);
  // Half a second of latency and a second of acceleration are missing.
  EXPECT_GT(straight.translation.x(), 1.4);
  EXPECT_LT(straight.translation.x(), 2.5);
  EXPECT_LT(std::abs(straight.translation.y()), 0.05);
  EXPECT_GT(simulator_->wheel_angles()[0], 1.4 / 0.15);
  Drive(0.0, 0.0, 3.0);
  const SE3 turn = Drive(0.0, 0.2, 4.0);
  EXPECT_GT(Yaw(turn), 0.5);
  EXPECT_LT(Yaw(turn), 0.8);
  EXPECT_LT(turn.translation.norm(), 0.1);
  Drive(0.0, 0.0, 3.0);
  EXPECT_LT(Drive(-0.4, 0.0, 4.0).translation.x(), -0.9);
  // Commands that are none, or too much.
  Drive(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 3.0);
  EXPECT_LT(Drive(0.0, 0.0, 1.0).translation.norm(), 1e-3);
  EXPECT_LT(Drive(50.0, 0.0, 3.0).translation.norm(), 3.0 * LiveDriveLimits::kSpeed);
  Drive(0.8, 0.0, 55.0);
  EXPECT_FALSE(simulator_->obstacle().empty());
  EXPECT_LT(Drive(0.8, 0.0, 1.0).translation.norm(), 1e-3);
  EXPECT_LT(Drive(-0.8, 0.0, 3.0).translation.x(), -0.5);
  EXPECT_TRUE(simulator_->obstacle().empty());
}

TEST_F(LiveSimulatorTest, StopsBeforeRocks) {
  ScenarioOptions options = Plain();
  options.terrain.rocks.law = RockLaw::kPower;
  options.terrain.rocks.density = 0.3;
  options.lidar.rate = 2.0;
  Make(options);
  Drive(0.8, 0.0, 40.0);
  EXPECT_EQ(simulator_->obstacle(), "a rock");
}

TEST_F(LiveSimulatorTest, TheSameCommandsGiveTheSameMeasurements) {
  Make(Plain());
  const SE3 first = Drive(0.5, 0.1, 1.5);
  Make(Plain());
  const SE3 second = Drive(0.5, 0.1, 1.5);
  EXPECT_EQ(first.translation, second.translation);
}

TEST_F(LiveSimulatorTest, RefusesACameraThatNoRoverHas) {
  EXPECT_THROW(Make(Plain(), "rear"), CheckError);
}

}  // namespace
}  // namespace regolith
