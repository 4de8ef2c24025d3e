// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace regolith {

/// A headlight at one instant.
struct Lamp {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();  ///< m, world
  Eigen::Vector3f axis = Eigen::Vector3f::UnitX();  ///< unit vector, world
  float irradiance = 0.0F;                          ///< of the sun's, at 1 m on the axis; 0 is off
  float beam = 0.5F;  ///< rad off the axis where it sends half as much
};

}  // namespace regolith
