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

constexpr int kLongestLag = 32;           // posts
constexpr double kLargestSample = 2.0e5;  // differences a lag
constexpr size_t kSmallestSample = 50;
// Self-affine relief grows with the lag to a power of at most one. Fourth differences at a lag see
// wavelengths about twice as long; relief that is smoothed to half its amplitude there grows with
// this power (measured on surfaces of Hurst exponents .5 to .95, smoothed by Gaussians or
// interpolated from fewer posts).
constexpr double kSmoothedPower = 1.45;
// Second differences tell facets: between kinks they vanish, and so do fourth differences, which
// only see that kinks are many.
constexpr double kFacetPower = 1.7;

constexpr double kSecond[] = {1.0, -2.0, 1.0};
constexpr double kFourth[] = {1.0, -4.0, 6.0, -4.0, 1.0};

// Size of the differences at `lag` posts. The mean of square roots: a few spikes do not weigh, and
// quantised heights still give a smooth figure.
template <int kCount>
std::optional<double> RoughnessAt(const RasterLines& lines, const double (&weights)[kCount],
                                  int lag) {
  const int length = lines.length() - (kCount - 1) * lag;
  if (length < lag) return {};
  const double all = static_cast<double>(length) * lines.count();
  const int step = std::max(1, static_cast<int>(all / kLargestSample));
  double sum = 0.0;
  size_t count = 0;
  for (int line = 0; line < lines.count(); ++line) {
    for (int i = (line * 7) % step; i < length; i += step) {
      double difference = 0.0;
      for (int k = 0; k < kCount; ++k) {
        difference += weights[k] * static_cast<double>(lines.At(line, i + k * lag));
      }
      if (!std::isfinite(difference)) continue;
      sum += std::sqrt(std::abs(difference));
      ++count;
    }
  }
  if (count < kSmallestSample || sum <= 0.0) return {};
  return std::pow(sum / static_cast<double>(count), 2);
}

// The power with which the differences grow from `lag` to twice of it.
template <int kCount>
std::optional<double> PowerAt(const RasterLines& lines, const double (&weights)[kCount], int lag) {
  const std::optional<double> fine = RoughnessAt(lines, weights, lag);
  const std::optional<double> coarse = RoughnessAt(lines, weights, 2 * lag);
  if (!fine || !coarse) return {};
  return std::log2(*coarse / *fine);
}

// The lag (posts) from which on relief grows no faster than self-affine relief does.
double LagOfTrend(const RasterLines& lines) {
  double previous_excess = 0.0;
  for (int lag = 1; lag <= kLongestLag; lag *= 2) {
    const std::optional<double> power = PowerAt(lines, kFourth, lag);
    const std::optional<double> facets = PowerAt(lines, kSecond, lag);
    if (!power || !facets) return lag;
    const double excess = std::max(*power - kSmoothedPower, *facets - kFacetPower);
    if (excess <= 0.0) {
      if (lag == 1) return 1.0;
      return 0.5 * lag * std::exp2(previous_excess / (previous_excess - excess));
    }
    previous_excess = excess;
  }
  return kLongestLag;
}

}  // namespace

double EffectiveResolution(const HeightGrid& grid) {
  const double lag = std::max(LagOfTrend({grid, false}), LagOfTrend({grid, true}));
  return 2.0 * lag * grid.spacing;
}

}  // namespace regolith
