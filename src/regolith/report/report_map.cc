// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/report_map.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

/// The values below which 2 and 98 per cent lie; never equal.
Eigen::Vector2f MiddleRange(std::vector<float> values) {
  const size_t low = values.size() / 50;
  const size_t high = values.size() - 1 - low;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(low), values.end());
  const float least = values[low];
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(high),
                   values.end());
  return {least, std::max(values[high], least + 1e-3F)};
}

void AppendCoordinate(float value, float low, float high, std::vector<uint8_t>* bytes) {
  const float share = high > low ? (value - low) / (high - low) : 0.0F;
  const auto step = static_cast<unsigned>(std::lround(std::clamp(share, 0.0F, 1.0F) * 65535.0F));
  bytes->push_back(static_cast<uint8_t>(step & 255U));
  bytes->push_back(static_cast<uint8_t>(step >> 8U));
}

}  // namespace

PackedMap PackMap(Span<const ReportMapPoint> points) {
  PackedMap map;
  map.count = points.size();
  if (points.empty()) return map;
  std::vector<float> heights;
  std::vector<float> intensities;
  map.low = map.high = points[0].position;
  for (const ReportMapPoint& point : points) {
    map.low = map.low.cwiseMin(point.position);
    map.high = map.high.cwiseMax(point.position);
    heights.push_back(point.position.z());
    intensities.push_back(point.intensity);
  }
  map.heights = MiddleRange(std::move(heights));
  map.intensities = MiddleRange(std::move(intensities));
  map.bytes.reserve(8 * points.size());
  const float span = map.intensities[1] - map.intensities[0];
  for (const ReportMapPoint& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      AppendCoordinate(point.position[axis], map.low[axis], map.high[axis], &map.bytes);
    }
    const float share = std::clamp((point.intensity - map.intensities[0]) / span, 0.0F, 1.0F);
    map.bytes.push_back(static_cast<uint8_t>(std::lround(255.0F * share)));
    map.bytes.push_back(0);
  }
  return map;
}

std::vector<size_t> ThinEvenly(size_t total, size_t limit) {
  std::vector<size_t> kept;
  if (total <= limit) {
    for (size_t i = 0; i < total; ++i) kept.push_back(i);
    return kept;
  }
  const double step = static_cast<double>(total) / static_cast<double>(limit);
  uint32_t state = 1;
  for (size_t i = 0; i < limit; ++i) {
    state = state * 1664525U + 1013904223U;  // Numerical Recipes' generator
    const double jitter = static_cast<double>(state >> 8U) / 16777216.0;
    kept.push_back(
        std::min(total - 1, static_cast<size_t>((static_cast<double>(i) + jitter) * step)));
  }
  return kept;
}

}  // namespace regolith
