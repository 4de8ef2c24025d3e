// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace regolith {

/// What a rock's surface has below its mesh: minerals and roughness.
struct RockGrain {
  float brightness = 1.0F;                          ///< factor on its albedo
  Eigen::Vector3f slope = Eigen::Vector3f::Zero();  ///< to take off its normal, rock's frame
};

/// The grain at a place (m, rock's frame), of all that a footprint `width` m wide leaves. Rocks of
/// other `seed` look otherwise.
RockGrain GrainOfRock(uint32_t seed, const Eigen::Vector3f& place, float width);

}  // namespace regolith
