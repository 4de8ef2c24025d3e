// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "regolith/terrain/dem_quality.h"
#include "regolith/terrain/raster_lines_internal.h"
#include "regolith/terrain/slope_statistics.h"

namespace regolith {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

// --- Holes ----------------------------------------------------------------------------------

constexpr int kSweeps = 40;  // of relaxation at each size of the raster

HeightGrid EmptyGrid(int columns, int rows) {
  HeightGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.heights.assign(static_cast<size_t>(columns) * static_cast<size_t>(rows), kMissing);
  return grid;
}

// Means of 2 × 2 posts, as far as they are known.
HeightGrid HalfSize(const HeightGrid& grid) {
  HeightGrid half = EmptyGrid((grid.columns + 1) / 2, (grid.rows + 1) / 2);
  for (int row = 0; row < half.rows; ++row) {
    for (int column = 0; column < half.columns; ++column) {
      double sum = 0.0;
      int count = 0;
      for (int j = 2 * row; j < std::min(grid.rows, 2 * row + 2); ++j) {
        for (int i = 2 * column; i < std::min(grid.columns, 2 * column + 2); ++i) {
          if (!std::isfinite(grid.At(i, j))) continue;
          sum += static_cast<double>(grid.At(i, j));
          ++count;
        }
      }
      if (count > 0) half.At(column, row) = static_cast<float>(sum / count);
    }
  }
  return half;
}

float MeanOfNeighbours(const HeightGrid& grid, int column, int row) {
  float sum = 0.0F;
  float count = 0.0F;
  const auto add = [&](bool inside, int i, int j) {
    if (!inside) return;
    sum += grid.At(i, j);
    count += 1.0F;
  };
  add(column > 0, column - 1, row);
  add(column + 1 < grid.columns, column + 1, row);
  add(row > 0, column, row - 1);
  add(row + 1 < grid.rows, column, row + 1);
  return count > 0.0F ? sum / count : grid.At(column, row);
}

// Laplace's equation with the posts around a hole as its border. Rasters of half the size carry the
// heights into wide holes, which sweeps alone would take thousands of turns for.
void FillHoles(HeightGrid* grid) {
  std::vector<size_t> holes;
  for (size_t i = 0; i < grid->heights.size(); ++i) {
    if (!std::isfinite(grid->heights[i])) holes.push_back(i);
  }
  if (holes.empty() || holes.size() == grid->heights.size()) return;
  HeightGrid half = HalfSize(*grid);
  FillHoles(&half);
  const auto columns = static_cast<size_t>(grid->columns);
  for (const size_t i : holes) {
    grid->heights[i] = half.At(static_cast<int>(i % columns) / 2, static_cast<int>(i / columns) / 2);
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const size_t i : holes) {
      grid->heights[i] =
          MeanOfNeighbours(*grid, static_cast<int>(i % columns), static_cast<int>(i / columns));
    }
  }
}

// --- Stripes --------------------------------------------------------------------------------

constexpr int kNeighbours = 4;         // lines on either side that say where a line should lie
constexpr int kHalfWindow = 32;        // posts along a line over which its offset is the same
constexpr double kClampSpreads = 3.0;  // relief beyond them says nothing about an offset
constexpr double kSigmaPerMedian = 1.4826;

// A line's posts less what the lines on both sides lead to expect; NaN where that is not known.
std::vector<double> OffNeighbours(const RasterLines& lines, int line) {
  const int reach = std::min({kNeighbours, line, lines.count() - 1 - line});
  std::vector<double> off(static_cast<size_t>(lines.length()), static_cast<double>(kMissing));
  for (int along = 0; along < lines.length() && reach > 0; ++along) {
    double sum = 0.0;
    for (int k = 1; k <= reach; ++k) {
      sum += static_cast<double>(lines.At(line - k, along)) + lines.At(line + k, along);
    }
    off[static_cast<size_t>(along)] =
        static_cast<double>(lines.At(line, along)) - sum / (2.0 * reach);
  }
  return off;
}

double SpreadOf(const std::vector<double>& values) {
  std::vector<double> known;
  for (const double value : values) {
    if (std::isfinite(value)) known.push_back(value);
  }
  return known.empty() ? 0.0 : kSigmaPerMedian * MedianMagnitude(std::move(known));
}

// The part of a line's offset that windows along it share, shrunk (Wiener 1949) by what noise and
// relief would leave of themselves in such a mean.
std::vector<double> OffsetsOf(const RasterLines& lines, int line, double stripes) {
  const std::vector<double> off = OffNeighbours(lines, line);
  const double spread = SpreadOf(off);
  const double limit = kClampSpreads * spread;
  std::vector<double> sums(off.size() + 1, 0.0);
  std::vector<double> counts(off.size() + 1, 0.0);
  for (size_t i = 0; i < off.size(); ++i) {
    const bool known = std::isfinite(off[i]);
    sums[i + 1] = sums[i] + (known ? std::clamp(off[i], -limit, limit) : 0.0);
    counts[i + 1] = counts[i] + (known ? 1.0 : 0.0);
  }
  std::vector<double> offsets(off.size(), 0.0);
  for (size_t i = 0; i < off.size(); ++i) {
    const size_t first = i > kHalfWindow ? i - kHalfWindow : 0;
    const size_t last = std::min(off.size(), i + kHalfWindow + 1);
    const double count = counts[last] - counts[first];
    if (count < kHalfWindow) continue;
    const double share = stripes * stripes / (stripes * stripes + spread * spread / count);
    offsets[i] = share * (sums[last] - sums[first]) / count;
  }
  return offsets;
}

void RemoveStripes(HeightGrid* grid, bool columns, double stripes) {
  const HeightGrid before = *grid;
  const RasterLines lines{before, columns};
  for (int line = 0; line < lines.count(); ++line) {
    const std::vector<double> offsets = OffsetsOf(lines, line, stripes);
    for (int along = 0; along < lines.length(); ++along) {
      float& height = columns ? grid->At(line, along) : grid->At(along, line);
      height -= static_cast<float>(offsets[static_cast<size_t>(along)]);
    }
  }
}

}  // namespace

HeightGrid Repaired(const HeightGrid& grid, const DemQuality& quality) {
  HeightGrid repaired = grid;
  for (const size_t spike : quality.spikes) repaired.heights[spike] = kMissing;
  FillHoles(&repaired);
  if (quality.rows_striped) RemoveStripes(&repaired, false, quality.row_stripes);
  if (quality.columns_striped) RemoveStripes(&repaired, true, quality.column_stripes);
  return repaired;
}

}  // namespace regolith
