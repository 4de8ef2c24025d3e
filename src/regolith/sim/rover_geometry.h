// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "regolith/geometry/se3.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// Half the distances between the wheels' contact points, m.
inline constexpr double kHalfWheelbase = 0.42;
inline constexpr double kHalfTrack = 0.36;
inline constexpr double kHalfWheelWidth = 0.08;
/// Height of the body's lower side above level ground, m.
inline constexpr double kBellyClearance = 0.25;

/// Frame `base` lies on the ground between the wheels, x forward, y left, z up.
SE3 BaseFromImu();
SE3 BaseFromLidar(const LidarOptions& options);
/// The cameras that a recording has, the middle one first.
std::vector<std::string> CameraNames(const CameraOptions& options);
/// `camera`: "mono", "left" or "right".
SE3 BaseFromCamera(const CameraOptions& options, const std::string& camera);

/// A part of the rover's body.
struct RoverBox {
  SE3 T_base_box;                                       ///< at its centre
  Eigen::Vector3d half_size = Eigen::Vector3d::Zero();  ///< m
};

/// Chassis, wheels, mast, camera bar and antenna: what casts the rover's shadow.
std::vector<RoverBox> RoverBody();

CameraIntrinsics MakeIntrinsics(const CameraOptions& options);

/// What the rig file says of a rover with these cameras: everything but the hidden errors (clock,
/// slip, radius, biases).
RigCalibration NominalRig(const ScenarioOptions& options, const std::vector<std::string>& cameras);

}  // namespace regolith
