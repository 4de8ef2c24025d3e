// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/geometry/se3.h"
#include "regolith/sim/drive.h"
#include "regolith/sim/ground.h"
#include "regolith/sim/scenario_options.h"
#include "regolith/sim/suspension.h"
#include "regolith/sim/uniform_spline.h"
#include "regolith/sim/vibration.h"

namespace regolith {

/// The body's exact motion at one time.
struct MotionState {
  SE3 T_world_imu;
  Eigen::Vector3d v_world_imu = Eigen::Vector3d::Zero();           ///< m/s
  Eigen::Vector3d a_world_imu = Eigen::Vector3d::Zero();           ///< m/s²
  Eigen::Vector3d angular_velocity_imu = Eigen::Vector3d::Zero();  ///< rad/s, body frame
};

/// Time between control points of the motion, s.
inline constexpr double kMotionInterval = 0.1;

/// The rover's motion: a C⁴ spline through poses that rest on the ground, and vibration on top.
/// Frame `world`: origin and yaw 0 at the first IMU pose.
class RoverMotion {
 public:
  /// `path` at kMotionInterval, in the surface's frame. Throws InputError where the rover cannot
  /// stand.
  RoverMotion(const Surface& surface, Span<const PlanarPose> path, const RoverOptions& rover,
              const VibrationOptions& vibration, uint64_t seed);

  /// Adds a pose kMotionInterval after the last one. Throws InputError where the rover cannot
  /// stand.
  void Append(const PlanarPose& pose, const RoverOptions& rover, Suspension* suspension);
  /// Time (s) up to which further poses change nothing.
  double settled() const { return spline_.settled(); }

  /// At `time` s since the start.
  MotionState At(double time) const;
  /// Likewise without vibration: what wheels follow.
  MotionState SmoothAt(double time) const;
  SE3 PoseAt(double time) const;

  /// Where world's origin lies in the surface's frame, m.
  const Eigen::Vector3d& origin() const { return origin_; }

 private:
  // [x y z yaw pitch roll speed]
  using Spline = UniformSpline<7>;

  static MotionState ToState(const Spline::Value& value);

  Spline spline_;
  Vibration vibration_;
  double reference_speed_;
  Eigen::Vector3d origin_;
};

}  // namespace regolith
