// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "regolith/cloud/voxel_key.h"
#include "regolith/cloud/voxel_map_options.h"
#include "regolith/cloud/voxel_table.h"
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
/// well apart (after Vizzo et al. 2023). Memory is fixed, insertion and search are constant-time
/// and never move what is there; the result depends on the order of the calls only.
class VoxelMap {
 public:
  explicit VoxelMap(const VoxelMapOptions& options);

  /// Adds points (m, map frame) within the radius of `centre`, the sensor, where their voxel has
  /// room and none is near.
  void Add(Span<const Eigen::Vector3d> points, const Eigen::Vector3d& centre);

  /// Looks at a sixteenth of the voxels, in turn, and forgets those farther than the radius from
  /// `centre`: called once a scan it costs the same each time.
  void ForgetSomeFarFrom(const Eigen::Vector3d& centre);
  /// Forgets all voxels farther than the radius from `centre`.
  void ForgetFarFrom(const Eigen::Vector3d& centre);

  /// Up to `count` nearest points within `max_distance` (m, at most one voxel edge) of `query`.
  Neighbours Nearest(const Eigen::Vector3d& query, int count, double max_distance) const;

  double voxel_size() const { return options_.voxel_size; }
  double radius() const { return radius_; }  ///< m; less than the option once memory was short
  bool empty() const { return voxel_count() == 0; }
  size_t voxel_count() const { return keys_.size() - free_.size(); }
  /// All points, voxel by voxel.
  std::vector<Eigen::Vector3d> Points() const;

 private:
  static constexpr size_t kVoxelsPerPage = 256;

  /// A voxel's coordinates: lanes_ of x, then as many of y and of z.
  float* Coordinates(size_t voxel) {
    return pages_[voxel / kVoxelsPerPage].get() + (voxel % kVoxelsPerPage) * 3 * lanes_;
  }
  const float* Coordinates(size_t voxel) const {
    return const_cast<VoxelMap*>(this)->Coordinates(voxel);
  }
  Eigen::Vector3f PointAt(size_t voxel, size_t index) const;
  auto KeyAt() const {
    return [this](uint32_t voxel) { return keys_[voxel]; };
  }
  uint32_t FindOrInsert(VoxelKey key, const Eigen::Vector3d& centre);
  uint32_t NewVoxel(VoxelKey key);
  void Forget(size_t begin, size_t end, const Eigen::Vector3d& centre);
  void Erase(size_t voxel);
  void MakeRoom(const Eigen::Vector3d& centre);

  VoxelMapOptions options_;
  double inverse_size_;
  double radius_;
  float squared_spacing_;
  size_t lanes_;      ///< max_points_per_voxel, rounded up to whole vectors of the processor
  VoxelTable table_;  ///< a voxel keeps its index as long as it lives
  std::vector<VoxelKey> keys_;
  std::vector<uint16_t> counts_;  ///< 0: a free voxel
  std::vector<uint32_t> free_;
  std::vector<std::unique_ptr<float[]>> pages_;
  size_t next_to_look_at_ = 0;
};

}  // namespace regolith
