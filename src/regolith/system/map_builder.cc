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

void MapBuilder::Add(Span<const MapPoint> points, uint32_t scan) {
  for (const MapPoint& point : points) AddPoint(point, scan);
}

void MapBuilder::AddPoint(const MapPoint& point, uint32_t scan) {
  const VoxelKey key = KeyOf(point.position.cast<double>(), 1.0 / voxel_size_);
  if (!occupied_.insert(key).second) return;
  points_.push_back(point);
  scans_.push_back(scan);
  if (static_cast<int64_t>(points_.size()) > options_.max_points) Coarsen();
}

void MapBuilder::Coarsen() {
  const std::vector<MapPoint> old_points = std::exchange(points_, {});
  const std::vector<uint32_t> old_scans = std::exchange(scans_, {});
  occupied_.clear();
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
