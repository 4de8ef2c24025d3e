// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/terrain/height_grid.h"

namespace regolith {

/// A raster as its rows, or as its columns: what holds for the one is then written for both.
struct RasterLines {
  const HeightGrid& grid;
  bool columns = false;

  int count() const { return columns ? grid.columns : grid.rows; }
  int length() const { return columns ? grid.rows : grid.columns; }
  float At(int line, int along) const {
    return columns ? grid.At(line, along) : grid.At(along, line);
  }
};

}  // namespace regolith
