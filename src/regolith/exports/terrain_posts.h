// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/thread_pool.h"
#include "regolith/terrain/surface.h"

namespace regolith {

/// A square of ground as the exports carry it. Post (i, j) lies at x = (i - (count - 1) / 2) ·
/// spacing, y likewise with j (m; frame of the exports: x east, y north, z up, the origin in the
/// middle), so the rows run from south to north.
struct TerrainPosts {
  int count = 0;                ///< posts a side
  double spacing = 1.0;         ///< m
  std::vector<double> heights;  ///< m, count²

  double side() const { return spacing * (count - 1); }
  double Coordinate(int i) const { return (i - 0.5 * (count - 1)) * spacing; }
  double Height(int i, int j) const {
    return heights[static_cast<size_t>(j) * static_cast<size_t>(count) + static_cast<size_t>(i)];
  }
  /// The unit normal at a post, by central differences.
  Eigen::Vector3d Normal(int i, int j) const;
};

/// `count`² posts of `surface` over the square of `side` m about `centre` (m), rocks included as
/// far as posts so far apart can carry them; `height_shift` (m) is added to each height. The same
/// for any number of threads.
TerrainPosts SampleTerrain(const Surface& surface, const Eigen::Vector2d& centre, double side,
                           int count, double height_shift, ThreadPool* pool);

/// Lowest and highest post, m.
struct HeightRange {
  double lowest = 0.0;
  double highest = 0.0;
};
HeightRange RangeOf(const TerrainPosts& posts);

/// A post where a rover can be set down: the flattest square of `width` m in the inner half.
struct Place {
  double x = 0.0;       ///< m
  double y = 0.0;       ///< m
  double ground = 0.0;  ///< m, highest post of the square
};
Place FlattestPlace(const TerrainPosts& posts, double width);

}  // namespace regolith
