// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/terrain/height_grid.h"

namespace regolith {

/// What the rows, or the columns, of a raster have that relief and noise do not account for.
struct Stripes {
  double offsets = 0.0;  ///< m, RMS of offsets that runs of a line share
  double tracks = 0.0;   ///< m, RMS of the lines' roughness in excess of their neighbours'
  bool striped = false;  ///< the offsets are no chance, and large enough to be seen
  bool tracked = false;  ///< likewise the roughness, where offsets do not explain it
};

/// Along the rows of `grid`, or along its columns. Relief agrees along them, too, over its
/// effective resolution (m).
Stripes FindStripes(const HeightGrid& grid, bool columns, double effective_resolution);

}  // namespace regolith
