// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/terrain/height_grid.h"

namespace regolith {

/// The shortest wavelength (m) that the raster truly carries, at least two posts: where relief has
/// lost half of its amplitude against the self-affine trend, as interpolation and smoothing leave
/// it. Holes are left out. Spikes hardly matter. A raster without relief claims two posts.
double EffectiveResolution(const HeightGrid& grid);

}  // namespace regolith
