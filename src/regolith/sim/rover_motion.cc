// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rover_motion.h"

#include <algorithm>
#include <cmath>

#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

// A wheel does not fall into what is narrower than itself.
constexpr double kWheelFootprint = 0.1;  // m

using Vector7 = Eigen::Matrix<double, 7, 1>;

struct Tilt {
  double height = 0.0;
  double pitch = 0.0;  // rad, nose down positive (about y)
  double roll = 0.0;   // rad, left side up positive (about x)
};

Tilt TiltOnWheels(const Surface& surface, const PlanarPose& pose) {
  const Eigen::Vector2d ahead(std::cos(pose.yaw), std::sin(pose.yaw));
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const auto height = [&](double x, double y) {
    const Eigen::Vector2d wheel = pose.position + x * ahead + y * left;
    return surface.Height(wheel.x(), wheel.y(), kWheelFootprint);
  };
  const double front_left = height(kHalfWheelbase, kHalfTrack);
  const double front_right = height(kHalfWheelbase, -kHalfTrack);
  const double back_left = height(-kHalfWheelbase, kHalfTrack);
  const double back_right = height(-kHalfWheelbase, -kHalfTrack);
  Tilt tilt;
  tilt.height = 0.25 * (front_left + front_right + back_left + back_right);
  tilt.pitch =
      -std::atan2(0.5 * (front_left + front_right - back_left - back_right), 2.0 * kHalfWheelbase);
  tilt.roll =
      std::atan2(0.5 * (front_left + back_left - front_right - back_right), 2.0 * kHalfTrack);
  return tilt;
}

Eigen::Quaterniond FromYawPitchRoll(double yaw, double pitch, double roll) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

Vector7 ControlPoint(const Surface& surface, const PlanarPose& pose) {
  const Tilt tilt = TiltOnWheels(surface, pose);
  const Eigen::Vector3d base(pose.position.x(), pose.position.y(), tilt.height);
  Vector7 control;
  control.head<3>() =
      base + FromYawPitchRoll(pose.yaw, tilt.pitch, tilt.roll) * BaseFromImu().translation;
  control.tail<4>() << pose.yaw, tilt.pitch, tilt.roll, pose.speed;
  return control;
}

PlanarPose Moved(PlanarPose pose, const Eigen::Vector2d& offset) {
  pose.position += offset;
  return pose;
}

}  // namespace

SE3 RestOnWheels(const Surface& surface, const PlanarPose& pose) {
  const Tilt tilt = TiltOnWheels(surface, pose);
  return {FromYawPitchRoll(pose.yaw, tilt.pitch, tilt.roll),
          Eigen::Vector3d(pose.position.x(), pose.position.y(), tilt.height)};
}

double SteepestSlope(const Surface& surface, Span<const PlanarPose> path,
                     const Eigen::Vector2d& offset) {
  double steepest = 0.0;
  for (const PlanarPose& planned : path) {
    const PlanarPose pose = Moved(planned, offset);
    const Tilt tilt = TiltOnWheels(surface, pose);
    const double body = std::acos(std::cos(tilt.pitch) * std::cos(tilt.roll));
    const Eigen::Vector2d half = 0.5 * Eigen::Vector2d(std::cos(pose.yaw), std::sin(pose.yaw));
    const Eigen::Vector2d front = pose.position + half;
    const Eigen::Vector2d back = pose.position - half;
    const double along = std::atan(surface.Height(front.x(), front.y(), kWheelFootprint) -
                                   surface.Height(back.x(), back.y(), kWheelFootprint));
    steepest = std::max({steepest, body, std::abs(along)});
  }
  return steepest;
}

RoverMotion::RoverMotion(const Surface& surface, Span<const PlanarPose> path,
                         const Eigen::Vector2d& offset, const VibrationOptions& vibration,
                         uint64_t seed)
    : vibration_(vibration, seed), reference_speed_(vibration.reference_speed) {
  std::vector<Vector7> controls;
  controls.reserve(path.size());
  for (const PlanarPose& pose : path) {
    controls.push_back(ControlPoint(surface, Moved(pose, offset)));
  }
  origin_ = controls.front().head<3>();
  for (Vector7& control : controls) control.head<3>() -= origin_;
  spline_ = Spline(std::move(controls), kMotionInterval);
}

MotionState RoverMotion::ToState(const Spline::Value& value) {
  const double pitch = value.value[4];
  const double roll = value.value[5];
  const double yaw_rate = value.first[3];
  const double pitch_rate = value.first[4];
  const double roll_rate = value.first[5];
  MotionState state;
  state.T_world_imu = SE3(FromYawPitchRoll(value.value[3], pitch, roll), value.value.head<3>());
  state.v_world_imu = value.first.head<3>();
  state.a_world_imu = value.second.head<3>();
  // Rates of yaw, pitch and roll as a body rate (Diebel 2006, eq. 76 for the sequence z y x).
  state.angular_velocity_imu =
      Eigen::Vector3d(roll_rate - yaw_rate * std::sin(pitch),
                      pitch_rate * std::cos(roll) + yaw_rate * std::sin(roll) * std::cos(pitch),
                      yaw_rate * std::cos(roll) * std::cos(pitch) - pitch_rate * std::sin(roll));
  return state;
}

MotionState RoverMotion::At(double time) const {
  Spline::Value value = spline_.At(time);
  const Vibration::Value shake =
      vibration_.At(time, value.value[6] / reference_speed_, value.first[6] / reference_speed_,
                    value.second[6] / reference_speed_);
  value.value.head<6>() += shake.value;
  value.first.head<6>() += shake.first;
  value.second.head<6>() += shake.second;
  return ToState(value);
}

MotionState RoverMotion::SmoothAt(double time) const { return ToState(spline_.At(time)); }

SE3 RoverMotion::PoseAt(double time) const { return At(time).T_world_imu; }

}  // namespace regolith
