// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/sim/ground_tile.h"
#include "regolith/sim/scene.h"
#include "regolith/sim/sun_disc.h"

namespace regolith {

/// Share of the sun's disc that is seen from each of the places (m, world), by some rays each to
/// points spread over the disc (Vogel 1979), so that shadows have penumbras.
void CastSunlight(const Scene& scene, const SunDisc& sun, Span<const Eigen::Vector3f> places,
                  float* sunlit);

/// The same for the posts of a tile, row by row. Posts whose neighbours agree on the middle of the
/// disc get that answer.
std::vector<float> CastSunlightOnTile(const Scene& scene, const SunDisc& sun,
                                      const GroundTile& tile);

}  // namespace regolith
