// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/dem_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "regolith/terrain/effective_resolution.h"
#include "regolith/terrain/slope_statistics.h"

namespace regolith {
namespace {

constexpr double kSigmaPerMedian = 1.4826;  // of |deviation|, of normal deviates
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr size_t kLargestSample = 200000;

double RobustSpread(std::vector<double> deviations) {
  return deviations.empty() ? 0.0 : kSigmaPerMedian * MedianMagnitude(std::move(deviations));
}

// --- Spikes ---------------------------------------------------------------------------------

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
      spreads_.push_back(RobustSpread(std::move(block)));
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

// --- Stripes --------------------------------------------------------------------------------

constexpr int kShortestRun = 8;           // posts
constexpr double kClampSpreads = 4.0;     // beyond which a difference counts no more
constexpr double kVisibleShare = 0.06;    // of the spread of a line against its neighbours
constexpr double kSignificance = 5.0;     // standard errors
constexpr double kMostPosts = 2.0e6;      // looked at
constexpr double kOffsetVariances = 1.5;  // of a line less the mean of its neighbours

// Lines of posts through a raster: the steps (columns, rows) along a line, and to the next one.
struct Direction {
  int along[2];
  int across[2];
};
constexpr Direction kRows{{1, 0}, {0, 1}};
constexpr Direction kColumns{{0, 1}, {1, 0}};
constexpr Direction kDiagonals{{1, 1}, {1, -1}};

// A post less the mean of those on the neighbouring lines.
double AgainstNeighbours(const HeightGrid& grid, const Direction& way, int column, int row) {
  return static_cast<double>(grid.At(column, row)) -
         0.5 * (static_cast<double>(grid.At(column - way.across[0], row - way.across[1])) +
                grid.At(column + way.across[0], row + way.across[1]));
}

double SpreadAgainstNeighbours(const HeightGrid& grid, const Direction& way) {
  const int step = static_cast<int>(grid.heights.size() / kLargestSample) + 1;
  std::vector<double> sample;
  for (int row = 1; row + 1 < grid.rows; ++row) {
    for (int column = 1 + (row * 7) % step; column + 1 < grid.columns; column += step) {
      const double value = AgainstNeighbours(grid, way, column, row);
      if (std::isfinite(value)) sample.push_back(value);
    }
  }
  return RobustSpread(std::move(sample));
}

// How much rougher a post's line is than those beside it.
double AgainstRoughness(const HeightGrid& grid, const Direction& way, int column, int row,
                        double limit) {
  const auto roughness = [&](int k) {
    return std::min(limit, std::abs(AgainstNeighbours(grid, way, column + k * way.across[0],
                                                      row + k * way.across[1])));
  };
  double others = 0.0;
  for (const int k : {-8, -6, -4, 4, 6, 8}) others += roughness(k);
  return roughness(0) - others / 6.0;
}
constexpr int kRoughnessReach = 9;  // lines

// The mean over a run of a line that begins at a post; NaN where half of it is missing.
template <typename Value>
double RunMean(const Direction& way, const Eigen::Vector2i& first, int run, const Value& value) {
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < run; ++i) {
    const double at = value(first.x() + i * way.along[0], first.y() + i * way.along[1]);
    if (!std::isfinite(at)) continue;
    sum += at;
    ++count;
  }
  return 2 * count > run ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

// What runs of one line have in common that do not touch: its mean square, and that figure's error.
struct Shared {
  double square = 0.0;  // m²
  double error = 0.0;   // m²
};

// `value` looks at posts up to `reach` away from its own.
template <typename Value>
Shared SharedAlong(const HeightGrid& grid, const Direction& way, int run, int reach,
                   const Value& value) {
  const Eigen::Vector2i along(way.along[0], way.along[1]);
  const int skip = static_cast<int>(static_cast<double>(grid.heights.size()) / kMostPosts) + 1;
  const Eigen::Vector2i step(along.x() == 1 ? run : skip, along.x() == 1 ? skip : run);
  const int end_column = grid.columns - reach - 3 * run * along.x();
  const int end_row = grid.rows - reach - 3 * run * along.y();
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (int row = reach; row < end_row; row += step.y()) {
    for (int column = reach; column < end_column; column += step.x()) {
      const Eigen::Vector2i first(column, row);
      const double product =
          RunMean(way, first, run, value) * RunMean(way, first + 2 * run * along, run, value);
      if (!std::isfinite(product)) continue;
      sum += product;
      squares += product * product;
      count += 1.0;
    }
  }
  if (count == 0.0) return {};
  return {sum / count, std::sqrt(squares) / count};
}

struct Excess {
  double square = 0.0;  // m²
  bool significant = false;
};

// Noise agrees along a line by chance only, and relief agrees along rows as it does along
// diagonals, where neither rows nor columns show.
Excess ExcessOf(const Shared& line, const Shared& diagonals) {
  const double square = line.square - std::max(0.0, diagonals.square);
  return {std::max(0.0, square), square > kSignificance * std::hypot(line.error, diagonals.error)};
}

Stripes FindStripes(const HeightGrid& grid, const Direction& way, double effective_resolution) {
  const int run = std::max(kShortestRun,
                           static_cast<int>(std::ceil(2.0 * effective_resolution / grid.spacing)));
  const double spread = SpreadAgainstNeighbours(grid, way);
  const double limit = kClampSpreads * spread;
  const auto offsets = [&](const Direction& direction) {
    return SharedAlong(grid, direction, run, 1, [&](int column, int row) {
      return std::clamp(AgainstNeighbours(grid, direction, column, row), -limit, limit);
    });
  };
  const auto tracks = [&](const Direction& direction) {
    return SharedAlong(grid, direction, run, kRoughnessReach, [&](int column, int row) {
      return AgainstRoughness(grid, direction, column, row, limit);
    });
  };
  const Excess offset = ExcessOf(offsets(way), offsets(kDiagonals));
  const Excess track = ExcessOf(tracks(way), tracks(kDiagonals));
  Stripes stripes;
  stripes.offsets = std::sqrt(offset.square / kOffsetVariances);
  stripes.tracks = std::sqrt(track.square);
  const double visible = std::max(kVisibleShare * spread, kSmallestSpread);
  stripes.striped = offset.significant && stripes.offsets > visible;
  // Offsets make their lines rough, too.
  stripes.tracked = !stripes.striped && track.significant && stripes.tracks > visible;
  return stripes;
}

// --- Quantisation ---------------------------------------------------------------------------

constexpr double kCoarseShare = 0.05;  // of the median step between neighbours
constexpr double kMostSteps = 10.0;    // to which multiples of the step are looked at
constexpr double kMultiples = 0.98;    // of them have to be multiples

std::vector<double> HeightSteps(const HeightGrid& grid, double rounding) {
  std::vector<double> steps;
  const size_t stride = grid.heights.size() / kLargestSample + 1;
  for (size_t i = 1; i < grid.heights.size(); i += stride) {
    const double step = std::abs(static_cast<double>(grid.heights[i]) - grid.heights[i - 1]);
    if (std::isfinite(step) && step > rounding) steps.push_back(step);
  }
  std::sort(steps.begin(), steps.end());
  return steps;
}

double FindQuantisation(const HeightGrid& grid) {
  double largest = 0.0;
  for (const float height : grid.heights) {
    if (std::isfinite(height)) largest = std::max(largest, std::abs(static_cast<double>(height)));
  }
  const double rounding =
      4.0 * largest * static_cast<double>(std::numeric_limits<float>::epsilon());
  const std::vector<double> steps = HeightSteps(grid, rounding);
  if (steps.size() < 100) return 0.0;
  // Not the very smallest, which may be a blunder.
  const double step = steps[steps.size() / 1000];
  if (step < kCoarseShare * steps[steps.size() / 2]) return 0.0;
  double seen = 0.0;
  double multiples = 0.0;
  for (const double value : steps) {
    if (value > kMostSteps * step) break;
    const double off = std::abs(value - step * std::round(value / step));
    seen += 1.0;
    if (off < 0.01 * value + rounding) multiples += 1.0;
  }
  return multiples >= kMultiples * seen ? step : 0.0;
}

}  // namespace

DemQuality AssessDem(const HeightGrid& grid) {
  DemQuality quality;
  quality.posts = grid.heights.size();
  for (const float height : grid.heights) quality.no_data += std::isfinite(height) ? 0 : 1;
  quality.spikes = SpikeFinder(grid).Find();
  quality.effective_resolution = EffectiveResolution(grid);
  quality.rows = FindStripes(grid, kRows, quality.effective_resolution);
  quality.columns = FindStripes(grid, kColumns, quality.effective_resolution);
  quality.quantisation = FindQuantisation(grid);
  return quality;
}

}  // namespace regolith
