// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace regolith {

/// Where a ray ended.
struct RayEnd {
  float distance = 0.0F;  ///< m; infinite for sky
  uint32_t object = 0;    ///< kNothing for sky
};

/// What a camera sees in an instant, before optics and sensor; row by row.
struct RenderedView {
  int width = 0;
  int height = 0;
  std::vector<float> radiance;    ///< I/F
  std::vector<float> distance;    ///< m along the pixel's ray; infinite for sky
  std::vector<uint32_t> objects;  ///< what the pixel's ray met

  size_t Index(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(column);
  }
  RayEnd End(int column, int row) const {
    const size_t i = Index(column, row);
    return {distance[i], objects[i]};
  }
};

}  // namespace regolith
