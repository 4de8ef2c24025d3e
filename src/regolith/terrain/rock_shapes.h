// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/terrain/rock.h"

namespace regolith {

inline constexpr uint32_t kRockShapes = 32;

/// kRockShapes irregular, faceted meshes with axes of about 2 : √2 : 1, the shortest roughly
/// upright (Golombek and Rapp 1997), sunk by 25 to 45 %. The mean of the horizontal extents is 1;
/// the heights above ground have the mean `height_share`.
std::vector<RockShape> MakeRockShapes(double height_share);

/// The upper side of the shapes as rasters: how high rocks stand.
class RockTops {
 public:
  explicit RockTops(const std::vector<RockShape>& shapes);

  /// Height (m, frame `map`) of the rock's upper side at (x, y) m; minus infinity beside the rock.
  double Top(const Rock& rock, double x, double y) const;

  /// Half of the widest shape's extent, diameters: no rock reaches farther from its centre.
  double reach() const { return reach_; }

 private:
  double reach_ = 0.0;
  std::vector<std::vector<float>> rasters_;
};

}  // namespace regolith
