// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/dem_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regolith/terrain/dem_spikes.h"
#include "regolith/terrain/effective_resolution.h"

namespace regolith {
namespace {

constexpr size_t kLargestSample = 200000;
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
  quality.spikes = FindSpikes(grid);
  quality.effective_resolution = EffectiveResolution(grid);
  quality.rows = FindStripes(grid, false, quality.effective_resolution);
  quality.columns = FindStripes(grid, true, quality.effective_resolution);
  quality.quantisation = FindQuantisation(grid);
  return quality;
}

}  // namespace regolith
