// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rover_motion.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/suspension.h"

namespace regolith {
namespace {

using Vector7 = Eigen::Matrix<double, 7, 1>;

Vector7 ControlPoint(const PlanarPose& pose, const RoverOptions& rover, Suspension* suspension) {
  const Stance stance = suspension->At(pose.position, pose.yaw);
  if (stance.travel > rover.rocker_travel) {
    throw InputError(
        "rover.rocker_travel",
        Concatenate("a wheel would have to move ", stance.travel, " m at x ", pose.position.x(),
                    ", y ", pose.position.y(), " m; choose another --seed or gentler ground"));
  }
  const Eigen::Vector3d base(pose.position.x(), pose.position.y(), stance.height);
  Vector7 control;
  control.head<3>() =
      base + FromYawPitchRoll(pose.yaw, stance.pitch, stance.roll) * BaseFromImu().translation;
  control.tail<4>() << pose.yaw, stance.pitch, stance.roll, pose.speed;
  return control;
}

}  // namespace

RoverMotion::RoverMotion(const Surface& surface, Span<const PlanarPose> path,
                         const RoverOptions& rover, const VibrationOptions& vibration,
                         uint64_t seed)
    : vibration_(vibration, seed), reference_speed_(vibration.reference_speed) {
  std::vector<Vector7> controls;
  controls.reserve(path.size());
  Suspension suspension(surface, rover);
  for (const PlanarPose& pose : path) controls.push_back(ControlPoint(pose, rover, &suspension));
  origin_ = controls.front().head<3>();
  for (Vector7& control : controls) control.head<3>() -= origin_;
  spline_ = Spline(std::move(controls), kMotionInterval);
}

void RoverMotion::Append(const PlanarPose& pose, const RoverOptions& rover,
                         Suspension* suspension) {
  Vector7 control = ControlPoint(pose, rover, suspension);
  control.head<3>() -= origin_;
  spline_.Append(control);
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
