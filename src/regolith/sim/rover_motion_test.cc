// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rover_motion.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/core/time.h"
#include "regolith/geometry/so3.h"
#include "regolith/imu/propagation.h"
#include "regolith/sim/drive_planner.h"
#include "regolith/sim/imu_simulator.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/test_surface_internal.h"

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

// How far dead reckoning from exact samples at `rate` Hz is from the truth, over the first minute.
struct Departure {
  double distance = 0.0;      // m, largest
  double angle = 0.0;         // rad, largest
  double rms_distance = 0.0;  // m
  double rms_angle = 0.0;     // rad
};

Departure DeadReckon(const RoverMotion& motion, double rate) {
  const auto sample_at = [&](int64_t i) {
    const double time = static_cast<double>(i) / rate;
    ImuSample sample = ExactImu(motion.At(time), kGravity);
    sample.time = AddSeconds(0, time);
    return sample;
  };
  NavState state;
  state.T_world_imu = motion.PoseAt(0.0);
  Departure departure;
  ImuSample from = sample_at(0);
  const auto count = static_cast<int64_t>(60.0 * rate);
  for (int64_t i = 1; i <= count; ++i) {
    const ImuSample to = sample_at(i);
    state = Propagate(state, from, to, {0.0, 0.0, -kGravity});
    from = to;
    const SE3 truth = motion.PoseAt(static_cast<double>(i) / rate);
    const double distance = (state.T_world_imu.translation - truth.translation).norm();
    const double angle = AngleBetween(state.T_world_imu.rotation, truth.rotation);
    departure.distance = std::max(departure.distance, distance);
    departure.angle = std::max(departure.angle, angle);
    departure.rms_distance += distance * distance;
    departure.rms_angle += angle * angle;
  }
  departure.rms_distance = std::sqrt(departure.rms_distance / static_cast<double>(count));
  departure.rms_angle = std::sqrt(departure.rms_angle / static_cast<double>(count));
  return departure;
}

TEST_F(RoverMotionTest, NoiseFreeImuIntegratesBackToTheTruth) {
  const Departure departure = DeadReckon(motion_, 5000.0);
  EXPECT_LT(departure.distance, 0.001);
  EXPECT_LT(departure.angle, 0.01 * kDegree);
  EXPECT_GT(motion_.PoseAt(60.0).translation.norm(), 15.0);
}

// The midpoint rule is of second order, so that what is left is the integrator's: an error of the
// samples would stay.
TEST_F(RoverMotionTest, DeadReckoningFromExactSamplesImprovesWithTheSquareOfTheirRate) {
  Departure slower = DeadReckon(motion_, 200.0);
  for (const double rate : {400.0, 800.0}) {
    const Departure faster = DeadReckon(motion_, rate);
    EXPECT_NEAR(slower.rms_distance / faster.rms_distance, 4.0, 0.6) << rate;
    EXPECT_NEAR(slower.rms_angle / faster.rms_angle, 4.0, 0.6) << rate;
    slower = faster;
  }
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

using Vector6 = Eigen::Matrix<double, 6, 1>;

// What vibration adds: acceleration (m/s², world) and body rate (rad/s).
Vector6 Shaking(const RoverMotion& motion, double time) {
  const MotionState shaken = motion.At(time);
  const MotionState smooth = motion.SmoothAt(time);
  Vector6 difference;
  difference << shaken.a_world_imu - smooth.a_world_imu,
      shaken.angular_velocity_imu - smooth.angular_velocity_imu;
  return difference;
}

// Straight ahead on level ground.
RoverMotion Steady(double speed, double seconds, const VibrationOptions& vibration, uint64_t seed) {
  static const TestSurface plane([](double, double) { return 0.0; });
  std::vector<PlanarPose> path;
  for (double time = 0.0; time < seconds; time += kMotionInterval) {
    path.push_back({{speed * time, 0.0}, 0.0, speed});
  }
  return {plane, path, RoverOptions{}, vibration, seed};
}

TEST_F(RoverMotionTest, ShakesAsAskedForAtHalfAMetreASecondAndInProportionToSpeed) {
  for (const double speed : {0.5, 0.25, 0.8}) {
    const RoverMotion motion = Steady(speed, 42.0, vibration_, 8);
    Vector6 squares = Vector6::Zero();
    const int count = 40000;
    for (int i = 0; i < count; ++i) squares += Shaking(motion, 1.0 + 0.001 * i).cwiseAbs2();
    const Vector6 rms = (squares / count).cwiseSqrt();
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(rms[axis], 0.3 * speed / 0.5, 0.01 * speed) << axis << " at " << speed;
      EXPECT_NEAR(rms[axis + 3], 0.02 * speed / 0.5, 0.001 * speed) << axis << " at " << speed;
    }
  }
}

TEST_F(RoverMotionTest, ShakesInProportionToSpeedOnARoughDriveToo) {
  Vector6 squares = Vector6::Zero();
  double speeds = 0.0;
  for (double time = 0.0; time < 60.0; time += 0.0013) {
    squares += Shaking(motion_, time).cwiseAbs2();
    speeds += motion_.SmoothAt(time).v_world_imu.squaredNorm();
  }
  const Vector6 per_speed = (squares / speeds).cwiseSqrt();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(per_speed[axis], 0.3 / 0.5, 0.06);
    EXPECT_NEAR(per_speed[axis + 3], 0.02 / 0.5, 0.004);
  }
}

TEST_F(RoverMotionTest, ShakesBetweenFiveAndFortyHertzAndAllOverThatBand) {
  const RoverMotion motion = Steady(0.5, 12.0, vibration_, 8);
  const double interval = 0.005;
  const int count = 2000;
  std::vector<Vector6> samples;
  for (int i = 0; i < count; ++i) {
    const double window = 0.5 - 0.5 * std::cos(2.0 * M_PI * i / count);
    samples.push_back(window * Shaking(motion, 1.0 + interval * i));
  }
  Vector6 inside = Vector6::Zero();
  Vector6 outside = Vector6::Zero();
  Vector6 upper = Vector6::Zero();
  for (double frequency = 0.1; frequency < 100.0; frequency += 0.1) {
    Vector6 cosines = Vector6::Zero();
    Vector6 sines = Vector6::Zero();
    for (int i = 0; i < count; ++i) {
      const double phase = 2.0 * M_PI * frequency * interval * i;
      cosines += std::cos(phase) * samples[static_cast<size_t>(i)];
      sines += std::sin(phase) * samples[static_cast<size_t>(i)];
    }
    const Vector6 power = cosines.cwiseAbs2() + sines.cwiseAbs2();
    (frequency > 4.8 && frequency < 40.2 ? inside : outside) += power;
    if (frequency > 22.5 && frequency < 40.2) upper += power;
  }
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_LT(outside[axis], 0.01 * inside[axis]) << axis;
    EXPECT_NEAR(upper[axis] / inside[axis], 0.5, 0.1) << axis;
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
  for (double time = 0.0; time < 60.0; time += 0.01) {
    const MotionState state = motion_.SmoothAt(time);
    const double rate = std::abs(state.angular_velocity_imu.z());
    if (time < 40.0) length += 0.01 * state.v_world_imu.norm();
    if (state.v_world_imu.norm() > 0.05) continue;
    fastest_turn = std::max(fastest_turn, rate);
    turned += 0.01 * rate;
  }
  EXPECT_GT(turned, 20.0 * kDegree);  // two turns of turn_deg 30, less what the legs take
  EXPECT_LT(fastest_turn, 21.0 * kDegree);
  EXPECT_GT(length, 17.0);
  EXPECT_LT(length, 19.0);
}

}  // namespace
}  // namespace regolith
