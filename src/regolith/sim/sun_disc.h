// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace regolith {

/// The sun as a light.
struct SunDisc {
  Eigen::Vector3f direction = Eigen::Vector3f::UnitZ();  ///< unit vector towards its centre, world
  float radius = 0.0F;                                   ///< half of its diameter, rad
};

}  // namespace regolith
