// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/sim/ground_tile.h"
#include "regolith/sim/photometry.h"

namespace regolith {

class Scene;

/// Light from the sky and, with `interreflection` by one bounce, from ground and rocks around, at
/// the fill posts of a tile (I/F of a white level surface): what fills shadows.
std::vector<float> CastFillLight(const Scene& scene, const Photometry& photometry,
                                 bool interreflection, const GroundTile& tile);

}  // namespace regolith
