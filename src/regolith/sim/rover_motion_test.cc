// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rover_motion.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/geometry/so3.h"
#include "regolith/sim/drive_planner.h"
#include "regolith/sim/imu_simulator.h"
#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kGravity = 1.62;

const Eigen::AlignedBox2d kBox(Eigen::Vector2d(-60, -60), Eigen::Vector2d(60, 60));

class RoverMotionTest : public testing::Test {
 protected:
  RoverMotionTest()
      : surface_(CreateGeneratedSurface(TerrainOptions{}, 3, kBox)),
        plan_(PlanDrive(*surface_, drive_, RoverOptions{}, 3, 64.0, kMotionInterval)),
        motion_(*surface_, plan_.path, RoverOptions{}, vibration_, 3) {}

  DriveOptions drive_;
  VibrationOptions vibration_;
  std::unique_ptr<Surface> surface_;
  Drive plan_;
  RoverMotion motion_;
};

TEST_F(RoverMotionTest, StartsAtTheOriginWithoutYawAndAtRest) {
  for (const double time : {0.0, 1.3, 2.5}) {
    const MotionState state = motion_.At(time);
    EXPECT_EQ(state.T_world_imu.translation, Eigen::Vector3d::Zero());
    const Eigen::Vector3d ahead = state.T_world_imu.rotation * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(ahead.y(), 0.0, 1e-12);
    EXPECT_EQ(state.v_world_imu, Eigen::Vector3d::Zero());
    EXPECT_EQ(state.angular_velocity_imu, Eigen::Vector3d::Zero());
    EXPECT_NEAR(ExactImu(state, kGravity).specific_force.norm(), kGravity, 1e-12);
  }
}

// Strapdown integration by the midpoint rule, 5 kHz, vibration included.
TEST_F(RoverMotionTest, NoiseFreeImuIntegratesBackToTheTruth) {
  const double step = 2e-4;
  SE3 pose = motion_.PoseAt(0.0);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double worst_distance = 0.0;
  double worst_angle = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const ImuSample sample = ExactImu(motion_.At((i + 0.5) * step), kGravity);
    const Eigen::Quaterniond half = pose.rotation * ExpSo3(0.5 * step * sample.angular_velocity);
    const Eigen::Vector3d acceleration =
        half * sample.specific_force - Eigen::Vector3d(0.0, 0.0, kGravity);
    pose.translation += step * velocity + 0.5 * step * step * acceleration;
    velocity += step * acceleration;
    pose.rotation = (pose.rotation * ExpSo3(step * sample.angular_velocity)).normalized();
    const SE3 truth = motion_.PoseAt((i + 1) * step);
    worst_distance = std::max(worst_distance, (pose.translation - truth.translation).norm());
    worst_angle = std::max(worst_angle, AngleBetween(pose.rotation, truth.rotation));
  }
  EXPECT_LT(worst_distance, 0.001);
  EXPECT_LT(worst_angle, 0.01 * kDegree);
  EXPECT_GT(pose.translation.norm(), 6.0);
}

TEST_F(RoverMotionTest, RestsOnItsWheels) {
  for (double time = 0.0; time < 40.0; time += 0.7) {
    const SE3 T_world_base = motion_.SmoothAt(time).T_world_imu * BaseFromImu().Inverse();
    double sum = 0.0;
    for (const double x : {-kHalfWheelbase, kHalfWheelbase}) {
      for (const double y : {-kHalfTrack, kHalfTrack}) {
        const Eigen::Vector3d wheel = T_world_base * Eigen::Vector3d(x, y, 0.0) + motion_.origin();
        const double gap = wheel.z() - surface_->Height(wheel.x(), wheel.y(), 0.1);
        EXPECT_NEAR(gap, 0.0, 0.08) << time;
        sum += gap;
      }
    }
    EXPECT_NEAR(sum / 4.0, 0.0, 0.02) << time;
  }
}

TEST_F(RoverMotionTest, VibrationHasTheRmsAskedFor) {
  const Vibration vibration(vibration_, 3);
  Eigen::Matrix<double, 6, 1> first = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 1> second = first;
  const int count = 40000;
  for (int i = 0; i < count; ++i) {
    const Vibration::Value value = vibration.At(i * 0.0011, 1.0, 0.0, 0.0);
    first += value.first.cwiseAbs2();
    second += value.second.cwiseAbs2();
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(second[axis] / count), 0.3, 0.03);
    EXPECT_NEAR(std::sqrt(first[axis + 3] / count), 0.02, 0.002);
  }
}

TEST_F(RoverMotionTest, PathHasSlopesButNoneTooSteep) {
  const double steepest = plan_.steepest;
  EXPECT_LT(steepest, 15.0 * kDegree);
  EXPECT_GT(steepest, 10.0 * kDegree);
}

TEST_F(RoverMotionTest, TurnsOnTheSpotWithinItsRateAndStops) {
  double fastest_turn = 0.0;
  double turned = 0.0;
  double length = 0.0;
  for (double time = 0.0; time < 40.0; time += 0.01) {
    const MotionState state = motion_.SmoothAt(time);
    const double rate = std::abs(state.angular_velocity_imu.z());
    length += 0.01 * state.v_world_imu.norm();
    if (state.v_world_imu.norm() > 0.05) continue;
    fastest_turn = std::max(fastest_turn, rate);
    turned += 0.01 * rate;
  }
  EXPECT_GT(turned, 20.0 * kDegree);  // turn_deg is 30, less what the leg takes
  EXPECT_LT(fastest_turn, 21.0 * kDegree);
  EXPECT_NEAR(length, 17.0, 1.5);
}

}  // namespace
}  // namespace regolith
