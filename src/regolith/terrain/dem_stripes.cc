// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/dem_stripes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "regolith/terrain/slope_statistics.h"

namespace regolith {
namespace {

constexpr double kLargestSample = 2.0e5;  // posts, for a spread
constexpr double kLeastVisible = 1e-4;    // m
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
  const int step = static_cast<int>(static_cast<double>(grid.heights.size()) / kLargestSample) + 1;
  std::vector<double> sample;
  for (int row = 1; row + 1 < grid.rows; ++row) {
    for (int column = 1 + (row * 7) % step; column + 1 < grid.columns; column += step) {
      const double value = AgainstNeighbours(grid, way, column, row);
      if (std::isfinite(value)) sample.push_back(value);
    }
  }
  return RobustSigma(std::move(sample));
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

}  // namespace

Stripes FindStripes(const HeightGrid& grid, bool columns, double effective_resolution) {
  const Direction& way = columns ? kColumns : kRows;
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
  const double visible = std::max(kVisibleShare * spread, kLeastVisible);
  stripes.striped = offset.significant && stripes.offsets > visible;
  // Offsets make their lines rough, too.
  stripes.tracked = !stripes.striped && track.significant && stripes.tracks > visible;
  return stripes;
}

}  // namespace regolith
