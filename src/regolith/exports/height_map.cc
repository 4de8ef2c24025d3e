// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/height_map.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "regolith/exports/png_file.h"

namespace regolith {

bool IsHeightMapSize(int count) {
  const int cells = count - 1;
  return count >= 17 && count <= 8193 && (cells & (cells - 1)) == 0;
}

HeightRange WriteHeightMap(const std::string& path, const TerrainPosts& posts) {
  constexpr double kWhite = 65535.0;
  HeightRange range = RangeOf(posts);
  // A plane has no range; a size of zero is refused by Gazebo.
  if (range.highest - range.lowest < 1e-3) range.highest = range.lowest + 1e-3;
  std::vector<uint16_t> grey;
  grey.reserve(posts.heights.size());
  for (int j = posts.count - 1; j >= 0; --j) {
    for (int i = 0; i < posts.count; ++i) {
      const double share = (posts.Height(i, j) - range.lowest) / (range.highest - range.lowest);
      grey.push_back(static_cast<uint16_t>(std::lround(kWhite * share)));
    }
  }
  WriteGreyPng16(path, posts.count, posts.count, grey);
  return range;
}

}  // namespace regolith
