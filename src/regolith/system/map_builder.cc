// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/map_builder.h"

#include <utility>

#include "regolith/core/check.h"

namespace regolith {

void MapBuilderOptions::Check() const {
  REGOLITH_CHECK(voxel_size > 0.0, "voxel_size=", voxel_size);
  REGOLITH_CHECK(max_points > 0, "max_points=", max_points);
}

MapBuilder::MapBuilder(const MapBuilderOptions& options)
    : options_(options), voxel_size_(options.voxel_size) {
  options.Check();
}

void MapBuilder::Add(Span<const MapPoint> points) {
  for (const MapPoint& point : points) {
    const VoxelKey key = KeyOf(point.position.cast<double>(), 1.0 / voxel_size_);
    if (!occupied_.insert(key).second) continue;
    points_.push_back(point);
    if (static_cast<int64_t>(points_.size()) > options_.max_points) Coarsen();
  }
}

void MapBuilder::Coarsen() {
  const std::vector<MapPoint> old = std::exchange(points_, {});
  occupied_.clear();
  voxel_size_ *= 2.0;
  Add(old);
}

}  // namespace regolith
