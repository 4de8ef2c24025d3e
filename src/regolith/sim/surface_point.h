// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace regolith {

/// What a surface is like at a place.
struct SurfacePoint {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float albedo = 0.1F;  ///< normal albedo
  float light = 0.0F;   ///< sunlit share · cosine of incidence
  float fill = 0.0F;    ///< light from the sky and from ground around, I/F of a white surface
};

}  // namespace regolith
