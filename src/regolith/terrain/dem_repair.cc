// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
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
    grid->heights[i] =
        half.At(static_cast<int>(i % columns) / 2, static_cast<int>(i / columns) / 2);
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const size_t i : holes) {
      grid->heights[i] =
          MeanOfNeighbours(*grid, static_cast<int>(i % columns), static_cast<int>(i / columns));
    }
  }
}

// --- Stripes --------------------------------------------------------------------------------

constexpr int kHalfWindow = 32;           // posts along a line over which its offset is the same
constexpr double kClampSpreads = 3.0;     // relief beyond them says nothing about an offset
constexpr double kOffsetVariances = 1.5;  // of a line less the mean of its neighbours
constexpr double kLeastNoise = 0.02;      // of the stripes' variance, or the solution runs away

using Values = std::vector<std::vector<double>>;  // of a line, of a post along it

// How far each post stands off the mean of the lines on both sides, m; zero on the outermost lines.
Values OffNeighbours(const RasterLines& lines) {
  Values off(static_cast<size_t>(lines.count()),
             std::vector<double>(static_cast<size_t>(lines.length()), 0.0));
  for (int line = 1; line + 1 < lines.count(); ++line) {
    double* value = off[static_cast<size_t>(line)].data();
    for (int i = 0; i < lines.length(); ++i) {
      const double sides = static_cast<double>(lines.At(line - 1, i)) + lines.At(line + 1, i);
      *value++ = static_cast<double>(lines.At(line, i)) - 0.5 * sides;
    }
  }
  return off;
}

// Means over the window around each post of a line.
std::vector<double> WindowMeans(const std::vector<double>& values) {
  const size_t length = values.size();
  std::vector<double> sums(length + 1, 0.0);
  for (size_t i = 0; i < length; ++i) sums[i + 1] = sums[i] + values[i];
  std::vector<double> means(length);
  for (size_t i = 0; i < length; ++i) {
    const size_t first = i > kHalfWindow ? i - kHalfWindow : 0;
    const size_t last = std::min(length, i + kHalfWindow + 1);
    means[i] = (sums[last] - sums[first]) / static_cast<double>(last - first);
  }
  return means;
}

// What windows along a line share.
void Average(Values* off) {
  for (std::vector<double>& line : *off) {
    const double limit = kClampSpreads * RobustSigma(line);
    for (double& value : line) value = std::clamp(value, -limit, limit);
    line = WindowMeans(line);
  }
}

// The offsets o of `count` lines that are the most likely where D o + noise = off was seen and the
// offsets are independent: (DᵀD + noise / stripes · 1) o = Dᵀ off with the rows (-½, 1, -½) of D.
// LDLᵀ of a matrix of five diagonals.
class OffsetSolver {
 public:
  OffsetSolver(size_t count, double noise_per_stripes)
      : diagonal_(count), first_(count, 0.0), second_(count, 0.0) {
    for (size_t j = 0; j < count; ++j) {
      const bool left = j >= 2;  // line j is the last of an equation
      const bool own = j >= 1 && j + 1 < count;
      const bool right = j + 2 < count;  // or its first
      diagonal_[j] =
          noise_per_stripes + (own ? 1.0 : 0.0) + 0.25 * ((left ? 1 : 0) + (right ? 1 : 0));
      if (j >= 1) first_[j] = -0.5 * ((own ? 1 : 0) + (j >= 2 ? 1 : 0));
      if (j >= 2) second_[j] = 0.25;
    }
    for (size_t j = 1; j < count; ++j) {
      if (j >= 2) {
        first_[j] -= second_[j] * first_[j - 1];
        diagonal_[j] -= second_[j] * second_[j] / diagonal_[j - 2];
        second_[j] /= diagonal_[j - 2];
      }
      diagonal_[j] -= first_[j] * first_[j] / diagonal_[j - 1];
      first_[j] /= diagonal_[j - 1];
    }
  }

  std::vector<double> Solve(const Values& off, size_t along) const {
    const size_t count = diagonal_.size();
    std::vector<double> offsets(count, 0.0);
    for (size_t j = 1; j + 1 < count; ++j) {
      const double value = off[j][along];
      offsets[j - 1] -= 0.5 * value;
      offsets[j] += value;
      offsets[j + 1] -= 0.5 * value;
    }
    for (size_t j = 1; j < count; ++j) {
      offsets[j] -= first_[j] * offsets[j - 1];
      if (j >= 2) offsets[j] -= second_[j] * offsets[j - 2];
    }
    for (size_t j = 0; j < count; ++j) offsets[j] /= diagonal_[j];
    for (size_t j = count; j-- > 0;) {
      if (j + 1 < count) offsets[j] -= first_[j + 1] * offsets[j + 1];
      if (j + 2 < count) offsets[j] -= second_[j + 2] * offsets[j + 2];
    }
    return offsets;
  }

 private:
  std::vector<double> diagonal_;
  std::vector<double> first_;   ///< below the diagonal: of lines j and j - 1
  std::vector<double> second_;  ///< of lines j and j - 2
};

void RemoveStripes(HeightGrid* grid, bool columns, double stripes) {
  const RasterLines lines{*grid, columns};
  Values off = OffNeighbours(lines);
  Average(&off);
  std::vector<double> all;
  for (const auto& line : off) all.insert(all.end(), line.begin(), line.end());
  const double variance = std::pow(RobustSigma(std::move(all)), 2);
  const double noise = variance / (stripes * stripes) - kOffsetVariances;
  const OffsetSolver solver(static_cast<size_t>(lines.count()), std::max(noise, kLeastNoise));
  for (int along = 0; along < lines.length(); ++along) {
    const std::vector<double> offsets = solver.Solve(off, static_cast<size_t>(along));
    for (int line = 0; line < lines.count(); ++line) {
      float& height = columns ? grid->At(line, along) : grid->At(along, line);
      height -= static_cast<float>(offsets[static_cast<size_t>(line)]);
    }
  }
}

// --- Tracks ---------------------------------------------------------------------------------

constexpr double kTrackRatio = 1.6;  // of a line's roughness to those beside it
constexpr double kEchoRatio = 0.75;  // a line next to a track looks half as rough as the track
constexpr int kBeside[] = {-8, -6, -4, 4, 6, 8};  // lines

double RoughnessBeside(const Values& roughness, size_t line, size_t along) {
  double sum = 0.0;
  double count = 0.0;
  for (const int k : kBeside) {
    const auto other = static_cast<int64_t>(line) + k;
    if (other < 1 || other + 1 >= static_cast<int64_t>(roughness.size())) continue;
    sum += roughness[static_cast<size_t>(other)][along];
    count += 1.0;
  }
  return count > 0.0 ? sum / count : roughness[line][along];
}

// Takes out of rough lines what makes them rougher than those beside them (Wiener 1949).
void RemoveTracks(HeightGrid* grid, bool columns) {
  const RasterLines lines{*grid, columns};
  const Values off = OffNeighbours(lines);
  Values roughness = off;
  for (std::vector<double>& line : roughness) {
    for (double& value : line) value = std::abs(value);
    line = WindowMeans(line);
  }
  for (size_t line = 1; line + 1 < off.size(); ++line) {
    for (size_t along = 0; along < off[line].size(); ++along) {
      const double own = roughness[line][along];
      const double beside = RoughnessBeside(roughness, line, along);
      const double next = std::max(roughness[line - 1][along], roughness[line + 1][along]);
      if (own <= kTrackRatio * beside || own <= kEchoRatio * next) continue;
      const auto at = static_cast<int>(along);
      const auto number = static_cast<int>(line);
      float& height = columns ? grid->At(number, at) : grid->At(at, number);
      height -= static_cast<float>((1.0 - std::pow(beside / own, 2)) * off[line][along]);
    }
  }
}

}  // namespace

HeightGrid Repaired(const HeightGrid& grid, const DemQuality& quality) {
  HeightGrid repaired = grid;
  for (const size_t spike : quality.spikes) repaired.heights[spike] = kMissing;
  FillHoles(&repaired);
  if (quality.rows.striped) RemoveStripes(&repaired, false, quality.rows.offsets);
  if (quality.columns.striped) RemoveStripes(&repaired, true, quality.columns.offsets);
  if (quality.rows.tracked) RemoveTracks(&repaired, false);
  if (quality.columns.tracked) RemoveTracks(&repaired, true);
  return repaired;
}

}  // namespace regolith
