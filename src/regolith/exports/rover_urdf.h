// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

#include "regolith/sim/scenario_options.h"

namespace regolith {

/// A part's mass (kg) and the diagonal of its inertia tensor about its own middle (kg m²); its axes
/// are the principal ones.
struct Inertia {
  double mass = 1.0;
  Eigen::Vector3d moments = Eigen::Vector3d::Ones();
};
/// `size`: m, along x, y, z.
Inertia BoxInertia(double mass, const Eigen::Vector3d& size);
/// About an axis along y.
Inertia WheelInertia(double mass, double radius, double width);

/// The rover of the simulator as a robot for ROS and Gazebo: chassis, four wheels with
/// transmissions, mast with the rig's cameras, a depth camera and a 16-line lidar, IMU,
/// differential drive and control; the sensors' places, rates, noise and topics are those of
/// `options`.
std::string RoverUrdf(const ScenarioOptions& options);

/// The same with xacro's properties and macros; xacro expands it to RoverUrdf(options).
std::string RoverXacro(const ScenarioOptions& options);

}  // namespace regolith
