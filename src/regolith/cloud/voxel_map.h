// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/cloud/voxel_key.h"
#include "regolith/cloud/voxel_map_options.h"
#include "regolith/core/span.h"

namespace regolith {

/// The nearest points that a search found, nearest first, m in the map's frame.
struct Neighbours {
  static constexpr int kMost = 12;
  int count = 0;
  std::array<Eigen::Vector3d, kMost> points;
  std::array<double, kMost> squared_distances{};

  Span<const Eigen::Vector3d> Points() const { return {points.data(), static_cast<size_t>(count)}; }
};

/// Points around the rover in a hash of cubic voxels, each of which keeps a few points that are
/// well apart (after Vizzo et al. 2023). Insertion and search are constant-time; the result depends
/// on the order of insertion only.
class VoxelMap {
 public:
  explicit VoxelMap(const VoxelMapOptions& options);

  /// Adds points (m, map frame) where their voxel has room and none is near.
  void Add(Span<const Eigen::Vector3d> points);

  /// Forgets voxels farther than the radius from `centre`.
  void RemoveFarFrom(const Eigen::Vector3d& centre);

  /// Up to `count` nearest points within `max_distance` (m, at most one voxel edge) of `query`.
  Neighbours Nearest(const Eigen::Vector3d& query, int count, double max_distance) const;

  double voxel_size() const { return options_.voxel_size; }
  bool empty() const { return keys_.empty(); }
  size_t voxel_count() const { return keys_.size(); }
  /// All points, voxel by voxel in the order in which the voxels appeared.
  std::vector<Eigen::Vector3d> Points() const;

 private:
  static constexpr uint32_t kEmptySlot = 0xffffffffU;

  const uint32_t* Find(VoxelKey key) const;
  uint32_t FindOrInsert(VoxelKey key);
  void Rehash(size_t slots);
  size_t SlotOf(VoxelKey key) const;

  VoxelMapOptions options_;
  double inverse_size_;
  float squared_spacing_;
  // Open addressing: slots hold indices into the voxels, which are stored without gaps.
  std::vector<uint32_t> slots_;
  std::vector<VoxelKey> keys_;
  std::vector<uint16_t> counts_;
  std::vector<Eigen::Vector3f> points_;  ///< max_points_per_voxel for each voxel
};

}  // namespace regolith
