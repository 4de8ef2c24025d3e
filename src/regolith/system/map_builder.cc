// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/map_builder.h"

#include <utility>

#include "regolith/core/check.h"

namespace regolith {

void MapBuilderOptions::Check() const {
  REGOLITH_CHECK(voxel_size > 0.0, "voxel_size=", voxel_size);
  REGOLITH_CHECK(max_points > 0 && max_points < 1'000'000'000, "max_points=", max_points);
}

MapBuilder::MapBuilder(const MapBuilderOptions& options)
    : options_(options),
      voxel_size_(options.voxel_size),
      occupied_(static_cast<size_t>(options.max_points) + 1) {
  options.Check();
  points_.reserve(static_cast<size_t>(options.max_points) + 1);
}

VoxelKey MapBuilder::KeyOfPoint(const MapPoint& point) const {
  return KeyOf(point.position.cast<double>(), 1.0 / voxel_size_);
}

void MapBuilder::Add(Span<const MapPoint> points) {
  const auto key_at = [this](uint32_t index) { return KeyOfPoint(points_[index]); };
  for (const MapPoint& point : points) {
    const VoxelKey key = KeyOfPoint(point);
    if (occupied_.Find(key, key_at) != VoxelTable::kNone) continue;
    occupied_.Insert(key, static_cast<uint32_t>(points_.size()), key_at);
    points_.push_back(point);
    if (static_cast<int64_t>(points_.size()) > options_.max_points) Coarsen();
  }
}

void MapBuilder::Coarsen() {
  const std::vector<MapPoint> old = std::exchange(points_, {});
  points_.reserve(old.capacity());
  occupied_ = VoxelTable(static_cast<size_t>(options_.max_points) + 1);
  voxel_size_ *= 2.0;
  Add(old);
}

}  // namespace regolith
