// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct VoxelMapOptions {
  double voxel_size = 0.5;        ///< m, edge of a voxel; neighbours are found up to this far
  int max_points_per_voxel = 20;  ///< memory is bounded by this and by the radius
  double radius = 100.0;          ///< m, points farther from the sensor are forgotten

  /// Throws CheckError on values that make no map.
  void Check() const;
};

}  // namespace regolith
