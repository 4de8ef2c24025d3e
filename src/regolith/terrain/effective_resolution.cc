// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/effective_resolution.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "regolith/terrain/raster_lines_internal.h"

namespace regolith {
namespace {

constexpr int kLongestLag = 64;           // posts
constexpr double kLargestSample = 2.0e5;  // differences a lag
constexpr size_t kSmallestSample = 50;
// Self-affine relief grows with the lag to a power of at most one. With this differences' order,
// relief smoothed to half its amplitude at 2 lags grows with this power there (measured on surfaces
// of Hurst exponents .5 to .95, smoothed by Gaussians and interpolated from fewer posts).
constexpr double kSmoothedPower = 1.5;

// Size of the fourth differences at `lag` posts, which see wavelengths about 2 lags. The mean of
// square roots: a few spikes do not weigh, and quantised heights still give a smooth figure.
std::optional<double> RoughnessAt(const RasterLines& lines, int lag) {
  const int length = lines.length() - 4 * lag;
  if (length < lag) return {};
  const double all = static_cast<double>(length) * lines.count();
  const int step = std::max(1, static_cast<int>(all / kLargestSample));
  double sum = 0.0;
  size_t count = 0;
  for (int line = 0; line < lines.count(); ++line) {
    for (int i = (line * 7) % step; i < length; i += step) {
      const double ends = static_cast<double>(lines.At(line, i)) + lines.At(line, i + 4 * lag);
      const double sides =
          static_cast<double>(lines.At(line, i + lag)) + lines.At(line, i + 3 * lag);
      const double difference = ends - 4.0 * sides + 6.0 * lines.At(line, i + 2 * lag);
      if (!std::isfinite(difference)) continue;
      sum += std::sqrt(std::abs(difference));
      ++count;
    }
  }
  if (count < kSmallestSample || sum <= 0.0) return {};
  return std::pow(sum / static_cast<double>(count), 2);
}

// The lag (posts) from which on relief grows no faster than self-affine relief does.
double LagOfTrend(const RasterLines& lines) {
  std::optional<double> fine = RoughnessAt(lines, 1);
  double previous_power = 0.0;
  for (int lag = 1; lag < kLongestLag && fine; lag *= 2) {
    const std::optional<double> coarse = RoughnessAt(lines, 2 * lag);
    if (!coarse) return lag;
    const double power = std::log2(*coarse / *fine);
    if (power <= kSmoothedPower) {
      if (lag == 1) return 1.0;
      return 0.5 * lag * std::exp2((previous_power - kSmoothedPower) / (previous_power - power));
    }
    previous_power = power;
    fine = coarse;
  }
  return fine ? kLongestLag : 1.0;
}

}  // namespace

double EffectiveResolution(const HeightGrid& grid) {
  const double lag = std::max(LagOfTrend({grid, false}), LagOfTrend({grid, true}));
  return 2.0 * lag * grid.spacing;
}

}  // namespace regolith
