// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/terrain_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "regolith/exports/png_file.h"

namespace regolith {
namespace {

constexpr double kMeanLevel = 150.0;
constexpr size_t kBlockRows = 32;

// Regolith is a little redder than grey; the dust of Mars is ferric.
Eigen::Vector3d Tint(const std::string& planet) {
  if (planet == "mars") return {1.18, 0.86, 0.62};
  return {1.02, 1.0, 0.96};
}

std::vector<float> SampleAlbedo(const Surface& surface, const Eigen::Vector2d& centre, double side,
                                int pixels, ThreadPool* pool) {
  const double spacing = side / pixels;
  const auto columns = static_cast<size_t>(pixels);
  std::vector<float> result(columns * columns);
  pool->ParallelFor(columns, kBlockRows, [&](size_t begin, size_t end, size_t) {
    PostBlock block;
    block.x = centre.x() - 0.5 * side + 0.5 * spacing;
    block.y = centre.y() - 0.5 * side + (static_cast<double>(begin) + 0.5) * spacing;
    block.spacing = spacing;
    block.columns = pixels;
    block.rows = static_cast<int>(end - begin);
    std::vector<double> heights;
    std::vector<float> albedo;
    surface.Sample(block, &heights, &albedo);
    std::copy(albedo.begin(), albedo.end(),
              result.begin() + static_cast<std::ptrdiff_t>(begin * columns));
  });
  return result;
}

}  // namespace

void WriteTerrainTexture(const std::string& path, const Surface& surface,
                         const Eigen::Vector2d& centre, double side, int pixels,
                         const std::string& planet, ThreadPool* pool) {
  const std::vector<float> albedo = SampleAlbedo(surface, centre, side, pixels, pool);
  double sum = 0.0;
  for (const float value : albedo) sum += value;
  const double gain = kMeanLevel * static_cast<double>(albedo.size()) / std::max(sum, 1e-9);
  const Eigen::Vector3d tint = Tint(planet);
  const auto columns = static_cast<size_t>(pixels);
  std::vector<uint8_t> colours;
  colours.reserve(3 * albedo.size());
  for (size_t row = columns; row-- > 0;) {
    for (size_t column = 0; column < columns; ++column) {
      const double level = gain * static_cast<double>(albedo[row * columns + column]);
      for (int k = 0; k < 3; ++k) {
        colours.push_back(static_cast<uint8_t>(std::clamp(std::lround(level * tint[k]), 0L, 255L)));
      }
    }
  }
  WriteColourPng(path, pixels, pixels, colours);
}

}  // namespace regolith
