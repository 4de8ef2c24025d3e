// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "regolith/terrain/dem_stripes.h"
#include "regolith/terrain/height_grid.h"

namespace regolith {

/// What an elevation model does not say, or says wrongly.
struct DemQuality {
  size_t posts = 0;
  size_t no_data = 0;          ///< posts
  std::vector<size_t> spikes;  ///< indices of posts that stand off all their neighbours
  Stripes rows;
  Stripes columns;
  double quantisation = 0.0;          ///< m, step of the heights where it is coarse; else 0
  double effective_resolution = 0.0;  ///< m, the shortest wavelength that it truly carries
};

DemQuality AssessDem(const HeightGrid& grid);

/// The same raster with stripes and tracks taken out, and spikes and posts without data replaced by
/// a membrane that hangs on the posts around them.
HeightGrid Repaired(const HeightGrid& grid, const DemQuality& quality);

}  // namespace regolith
