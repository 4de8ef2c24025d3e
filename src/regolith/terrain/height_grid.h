// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace regolith {

/// Heights on a regular grid, the rows from north to south as in a raster. Posts are points, not
/// cells: post (column, row) lies at x = origin.x + column · spacing, y = origin.y - row · spacing
/// (m, frame `map`).
struct HeightGrid {
  int columns = 0;
  int rows = 0;
  double spacing = 1.0;                              ///< m between posts, both ways
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, x and y of post (0, 0)
  std::vector<float> heights;  ///< m, rows × columns; NaN where there is no data
  std::string crs;             ///< well-known text; empty for plain metres

  float& At(int column, int row) {
    return heights[static_cast<size_t>(row) * static_cast<size_t>(columns) +
                   static_cast<size_t>(column)];
  }
  float At(int column, int row) const { return const_cast<HeightGrid*>(this)->At(column, row); }
};

}  // namespace regolith
