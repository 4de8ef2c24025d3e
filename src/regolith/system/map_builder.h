// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/cloud/map_point.h"
#include "regolith/cloud/voxel_table.h"
#include "regolith/core/span.h"
#include "regolith/geometry/se3.h"

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

  /// The points (world) of the scan of that number.
  void Add(Span<const MapPoint> points, uint32_t scan);

  const std::vector<MapPoint>& points() const { return points_; }
  /// The points, each moved as its scan was: `corrections`, one a scan, map the world in which it
  /// was added to that in which it is known to lie now. What loops bring together is not thinned
  /// again.
  std::vector<MapPoint> Moved(Span<const SE3> corrections) const;
  double voxel_size() const { return voxel_size_; }

 private:
  VoxelKey KeyOfPoint(const MapPoint& point) const;
  void Coarsen();
  void AddPoint(const MapPoint& point, uint32_t scan);

  MapBuilderOptions options_;
  double voxel_size_;
  std::vector<MapPoint> points_;
  std::vector<uint32_t> scans_;  ///< of the points
  VoxelTable occupied_;
};

}  // namespace regolith
