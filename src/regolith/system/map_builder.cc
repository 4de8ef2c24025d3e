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
  scans_.reserve(static_cast<size_t>(options.max_points) + 1);
}

VoxelKey MapBuilder::KeyOfPoint(const MapPoint& point) const {
  return KeyOf(point.position.cast<double>(), 1.0 / voxel_size_);
}

void MapBuilder::Add(Span<const MapPoint> points, uint32_t scan) {
  for (const MapPoint& point : points) AddPoint(point, scan);
}

void MapBuilder::AddPoint(const MapPoint& point, uint32_t scan) {
  const auto key_at = [this](uint32_t index) { return KeyOfPoint(points_[index]); };
  const VoxelKey key = KeyOfPoint(point);
  if (occupied_.Find(key, key_at) != VoxelTable::kNone) return;
  occupied_.Insert(key, static_cast<uint32_t>(points_.size()), key_at);
  points_.push_back(point);
  scans_.push_back(scan);
  if (static_cast<int64_t>(points_.size()) > options_.max_points) Coarsen();
}

void MapBuilder::Coarsen() {
  const std::vector<MapPoint> old_points = std::exchange(points_, {});
  const std::vector<uint32_t> old_scans = std::exchange(scans_, {});
  points_.reserve(old_points.capacity());
  scans_.reserve(old_scans.capacity());
  occupied_ = VoxelTable(static_cast<size_t>(options_.max_points) + 1);
  voxel_size_ *= 2.0;
  for (size_t i = 0; i < old_points.size(); ++i) AddPoint(old_points[i], old_scans[i]);
}

std::vector<MapPoint> MapBuilder::Moved(Span<const SE3> corrections) const {
  std::vector<MapPoint> moved = points_;
  for (size_t i = 0; i < moved.size(); ++i) {
    REGOLITH_CHECK(scans_[i] < corrections.size(), "scan ", scans_[i], " of ", corrections.size());
    moved[i].position = (corrections[scans_[i]] * moved[i].position.cast<double>()).cast<float>();
  }
  return moved;
}

}  // namespace regolith
