// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct VoxelMapOptions {
  double voxel_size = 0.5;        ///< m, edge of a voxel; neighbours are found up to this far
  int max_points_per_voxel = 20;  ///< more are not kept
  double radius = 100.0;          ///< m, points farther from the sensor are forgotten
  /// Bounds the memory. Where they do not suffice, the radius shrinks until they do.
  int max_voxels = 250000;

  /// Throws CheckError on values that make no map.
  void Check() const;
};

}  // namespace regolith
