// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "regolith/terrain/dem.h"
#include "regolith/terrain/fractal_noise.h"
#include "regolith/terrain/slope_statistics.h"
#include "regolith/terrain/surface_report.h"
#include "regolith/terrain/terrain_options.h"

namespace regolith {

/// Relief that an elevation model lacks, and what was chosen for it.
struct DemRelief {
  FractalNoise noise;
  SurfaceReport report;
};

/// Relief below the effective resolution (m) of `dem`, as its statistics over `box` (m) go on. What
/// `features` gives (m: craters, ripples) stands there too and is counted in. Slopes are those off
/// the plane through the box: a hillside is no roughness.
///
/// Where the model ends above 2 m, the figure of slopes over 1 m in `options` is kept, and the
/// Hurst exponent from there to the effective resolution follows from continuity with the model.
/// Below 1 m, and throughout where the model reaches finer, the exponent is that of `options`.
DemRelief ContinueRelief(const Dem& dem, double effective_resolution,
                         const HeightFunction& features, const ReliefOptions& options,
                         const Eigen::AlignedBox2d& box, uint64_t seed);

}  // namespace regolith
