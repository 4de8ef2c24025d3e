// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Core>

namespace regolith {

/// Index of a cubic voxel, 21 bits an axis packed into one word: ± a million voxels around the
/// origin.
using VoxelKey = uint64_t;

inline constexpr int kVoxelKeyBits = 21;
inline constexpr int64_t kVoxelKeyOffset = int64_t{1} << (kVoxelKeyBits - 1);

inline VoxelKey PackVoxel(int64_t x, int64_t y, int64_t z) {
  constexpr uint64_t kMask = (uint64_t{1} << kVoxelKeyBits) - 1;
  return ((static_cast<uint64_t>(x + kVoxelKeyOffset) & kMask) << (2 * kVoxelKeyBits)) |
         ((static_cast<uint64_t>(y + kVoxelKeyOffset) & kMask) << kVoxelKeyBits) |
         (static_cast<uint64_t>(z + kVoxelKeyOffset) & kMask);
}

/// The integer voxel that holds `point`, for voxels of edge 1 / `inverse_size`.
inline Eigen::Matrix<int64_t, 3, 1> VoxelOf(const Eigen::Vector3d& point, double inverse_size) {
  return {static_cast<int64_t>(std::floor(point.x() * inverse_size)),
          static_cast<int64_t>(std::floor(point.y() * inverse_size)),
          static_cast<int64_t>(std::floor(point.z() * inverse_size))};
}

inline VoxelKey KeyOf(const Eigen::Vector3d& point, double inverse_size) {
  const auto voxel = VoxelOf(point, inverse_size);
  return PackVoxel(voxel.x(), voxel.y(), voxel.z());
}

}  // namespace regolith
