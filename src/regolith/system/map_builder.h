// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/cloud/map_point.h"
#include "regolith/cloud/voxel_table.h"
#include "regolith/core/span.h"

namespace regolith {

struct MapBuilderOptions {
  double voxel_size = 0.1;         ///< m, one point a voxel is kept
  int64_t max_points = 4'000'000;  ///< beyond them the voxels double

  /// Throws CheckError on values that make no map.
  void Check() const;
};

/// Collects the map that is written out: the first point in each voxel, in the order in which they
/// were seen. Memory is bounded: voxels grow when their number reaches the limit.
class MapBuilder {
 public:
  explicit MapBuilder(const MapBuilderOptions& options);

  void Add(Span<const MapPoint> points);

  const std::vector<MapPoint>& points() const { return points_; }
  double voxel_size() const { return voxel_size_; }

 private:
  VoxelKey KeyOfPoint(const MapPoint& point) const;
  void Coarsen();

  MapBuilderOptions options_;
  double voxel_size_;
  std::vector<MapPoint> points_;
  VoxelTable occupied_;
};

}  // namespace regolith
