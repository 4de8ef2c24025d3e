// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/dem_spikes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "regolith/terrain/slope_statistics.h"

namespace regolith {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr int kBlock = 16;              // posts a side, in which the spread of residuals is taken
constexpr double kSpikeSpreads = 12.0;  // from what the neighbours predict
constexpr double kAloofSpreads = 6.0;   // from the nearest of them: summits and cliffs have company
constexpr double kSmallestSpread = 1e-4;  // m
constexpr int kPasses = 4;

struct Residual {
  float off = kMissing;    // m, from what the neighbours predict
  float aloof = kMissing;  // m, beyond the highest neighbour, or below the lowest
};

// Opposite neighbours' means agree on any slope; the median of the four ignores another spike.
Residual ResidualOf(const HeightGrid& grid, int column, int row) {
  const float height = grid.At(column, row);
  constexpr int kWays[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
  std::array<float, 4> means;
  size_t pairs = 0;
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -lowest;
  for (const auto& way : kWays) {
    const float one = grid.At(column - way[0], row - way[1]);
    const float other = grid.At(column + way[0], row + way[1]);
    for (const float neighbour : {one, other}) {
      if (!std::isfinite(neighbour)) continue;
      lowest = std::min(lowest, neighbour);
      highest = std::max(highest, neighbour);
    }
    const float mean = 0.5F * (one + other);
    if (std::isfinite(mean)) means[pairs++] = mean;
  }
  if (pairs < 3 || !std::isfinite(height)) return {};
  std::sort(means.begin(), means.begin() + static_cast<std::ptrdiff_t>(pairs));
  const float off = height - 0.5F * (means[(pairs - 1) / 2] + means[pairs / 2]);
  return {off, off > 0.0F ? height - highest : lowest - height};
}

// Spreads of the residuals, block by block; rough ground excuses what smooth ground does not.
class LocalSpread {
 public:
  LocalSpread(const HeightGrid& grid, const std::vector<Residual>& residuals)
      : columns_((grid.columns + kBlock - 1) / kBlock), rows_((grid.rows + kBlock - 1) / kBlock) {
    std::vector<std::vector<double>> blocks(static_cast<size_t>(columns_ * rows_));
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const float off = residuals[static_cast<size_t>(row) * static_cast<size_t>(grid.columns) +
                                    static_cast<size_t>(column)]
                              .off;
        if (std::isfinite(off)) blocks[Index(column / kBlock, row / kBlock)].push_back(off);
      }
    }
    std::vector<double> known;
    for (auto& block : blocks) {
      const bool empty = block.empty();
      spreads_.push_back(RobustSigma(std::move(block)));
      if (!empty) known.push_back(spreads_.back());
    }
    const double typical = known.empty() ? 0.0 : MedianMagnitude(std::move(known));
    floor_ = std::max(0.5 * typical, kSmallestSpread);
  }

  /// The largest of the block of a post and those around it.
  double At(int column, int row) const {
    double spread = floor_;
    for (int j = std::max(0, row / kBlock - 1); j <= std::min(rows_ - 1, row / kBlock + 1); ++j) {
      for (int i = std::max(0, column / kBlock - 1);
           i <= std::min(columns_ - 1, column / kBlock + 1); ++i) {
        spread = std::max(spread, spreads_[Index(i, j)]);
      }
    }
    return spread;
  }

 private:
  size_t Index(int column, int row) const { return static_cast<size_t>(row * columns_ + column); }

  int columns_;
  int rows_;
  std::vector<double> spreads_;
  double floor_;
};

class SpikeFinder {
 public:
  explicit SpikeFinder(const HeightGrid& grid) : grid_(grid), spread_(grid, Residuals()) {}

  // Beside a spike may stand a lower one, which comes out once that is gone.
  std::vector<size_t> Find() {
    std::vector<size_t> found;
    for (size_t i = 0; i < grid_.heights.size(); ++i) {
      if (IsSpike(i)) found.push_back(i);
    }
    std::vector<size_t> spikes = found;
    for (int pass = 1; pass < kPasses && !found.empty(); ++pass) {
      for (const size_t i : found) grid_.heights[i] = kMissing;
      found = Beside(found);
      spikes.insert(spikes.end(), found.begin(), found.end());
    }
    std::sort(spikes.begin(), spikes.end());
    return spikes;
  }

 private:
  std::vector<Residual> Residuals() const {
    std::vector<Residual> residuals;
    residuals.reserve(grid_.heights.size());
    for (size_t i = 0; i < grid_.heights.size(); ++i) residuals.push_back(ResidualAt(i));
    return residuals;
  }

  int ColumnOf(size_t index) const {
    return static_cast<int>(index % static_cast<size_t>(grid_.columns));
  }
  int RowOf(size_t index) const {
    return static_cast<int>(index / static_cast<size_t>(grid_.columns));
  }

  Residual ResidualAt(size_t index) const {
    const int column = ColumnOf(index);
    const int row = RowOf(index);
    if (column == 0 || row == 0 || column + 1 == grid_.columns || row + 1 == grid_.rows) return {};
    return ResidualOf(grid_, column, row);
  }

  bool IsSpike(size_t index) const {
    const Residual residual = ResidualAt(index);
    const auto aloof = static_cast<double>(residual.aloof);
    if (!(aloof > kAloofSpreads * kSmallestSpread)) return false;
    const double local = spread_.At(ColumnOf(index), RowOf(index));
    return std::abs(static_cast<double>(residual.off)) > kSpikeSpreads * local &&
           aloof > kAloofSpreads * local;
  }

  std::vector<size_t> Beside(const std::vector<size_t>& places) const {
    std::vector<size_t> found;
    const auto columns = static_cast<size_t>(grid_.columns);
    for (const size_t place : places) {
      for (const size_t row : {place - columns, place, place + columns}) {
        for (const size_t i : {row - 1, row, row + 1}) {
          if (IsSpike(i)) found.push_back(i);
        }
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  HeightGrid grid_;  // without the spikes found so far
  LocalSpread spread_;
};

}  // namespace

std::vector<size_t> FindSpikes(const HeightGrid& grid) { return SpikeFinder(grid).Find(); }

}  // namespace regolith
