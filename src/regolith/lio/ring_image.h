// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "regolith/sensor/lidar_scan.h"

namespace regolith {

/// A turn of a spinning lidar as an image: a row a ring, a column a step of azimuth. Row 0 looks
/// lowest, whatever the numbers of the rings; azimuth grows with the column, and the first follows
/// on the last. Rings without points have no row.
struct RingImage {
  static constexpr int32_t kEmpty = -1;

  int rows = 0;
  int columns = 0;
  std::vector<int32_t> indices;   ///< rows × columns, into the scan's points, or kEmpty
  std::vector<float> ranges;      ///< rows × columns, m; 0 where empty
  std::vector<float> elevations;  ///< rad, mean of each row
  int invalid_points = 0;         ///< not finite, at the lidar itself, or of a ring it has not
  int crowded_points = 0;         ///< left out, since their cell and the next to it were taken
  bool rings_reordered = false;   ///< the rings' numbers did not grow with their elevation

  size_t Cell(int row, int column) const {
    return static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column);
  }
  int32_t Index(int row, int column) const { return indices[Cell(row, column)]; }
  int Wrap(int column) const {
    return column < 0 ? column + columns : column >= columns ? column - columns : column;
  }

  /// The nearest cell of `row` that holds a point, at most `reach` columns from `column` and on one
  /// side of it: `direction` is 1 or -1, the columns looked at are column + direction · 1 … reach.
  std::optional<int> Next(int row, int column, int direction, int reach) const;
  /// The cell of `row` in `column` if it holds a point, else one beside it.
  std::optional<int> Near(int row, int column) const;
};

/// Orders a scan of up to `rings` rings, in any order of its points. The number of columns follows
/// from the azimuths themselves: a column is as wide as the lower quartile of the steps between
/// neighbours, so that three in four points may be missing. Points that fall into a taken cell move
/// to the next one on their side.
RingImage MakeRingImage(const LidarScan& scan, int rings);

}  // namespace regolith
