// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/voxel_map.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {

void VoxelMapOptions::Check() const {
  REGOLITH_CHECK(voxel_size > 0.0, "voxel_size=", voxel_size);
  REGOLITH_CHECK(max_points_per_voxel > 0 && max_points_per_voxel < 1000,
                 "max_points_per_voxel=", max_points_per_voxel);
  REGOLITH_CHECK(radius > voxel_size, "radius=", radius);
}

VoxelMap::VoxelMap(const VoxelMapOptions& options)
    : options_(options), inverse_size_(1.0 / options.voxel_size) {
  options.Check();
  // As many points as fit cover a square of the voxel's face evenly: surfaces, not volumes, are
  // mapped.
  squared_spacing_ =
      static_cast<float>(options.voxel_size * options.voxel_size / options.max_points_per_voxel);
  Rehash(1024);
}

void VoxelMap::Add(Span<const Eigen::Vector3d> points) {
  const auto most = static_cast<size_t>(options_.max_points_per_voxel);
  for (const Eigen::Vector3d& point : points) {
    const uint32_t voxel = FindOrInsert(KeyOf(point, inverse_size_));
    if (counts_[voxel] >= most) continue;
    const Eigen::Vector3f added = point.cast<float>();
    Eigen::Vector3f* const begin = points_.data() + voxel * most;
    Eigen::Vector3f* const end = begin + counts_[voxel];
    const bool crowded = std::any_of(begin, end, [&](const Eigen::Vector3f& other) {
      return (other - added).squaredNorm() < squared_spacing_;
    });
    if (crowded) continue;
    *end = added;
    ++counts_[voxel];
  }
}

void VoxelMap::RemoveFarFrom(const Eigen::Vector3d& centre) {
  const auto most = static_cast<size_t>(options_.max_points_per_voxel);
  const Eigen::Vector3f near = centre.cast<float>();
  const auto squared_radius = static_cast<float>(options_.radius * options_.radius);
  size_t kept = 0;
  for (size_t voxel = 0; voxel < keys_.size(); ++voxel) {
    if ((points_[voxel * most] - near).squaredNorm() > squared_radius) continue;
    if (kept != voxel) {
      keys_[kept] = keys_[voxel];
      counts_[kept] = counts_[voxel];
      std::copy_n(points_.begin() + static_cast<ptrdiff_t>(voxel * most), counts_[voxel],
                  points_.begin() + static_cast<ptrdiff_t>(kept * most));
    }
    ++kept;
  }
  if (kept == keys_.size()) return;
  keys_.resize(kept);
  counts_.resize(kept);
  points_.resize(kept * most);
  Rehash(slots_.size());
}

Neighbours VoxelMap::Nearest(const Eigen::Vector3d& query, int count, double max_distance) const {
  REGOLITH_CHECK(count > 0 && count <= Neighbours::kMost, "count=", count);
  const auto most = static_cast<size_t>(options_.max_points_per_voxel);
  const auto centre = VoxelOf(query, inverse_size_);
  const Eigen::Vector3f query_float = query.cast<float>();
  std::array<float, Neighbours::kMost> distances;
  std::array<const Eigen::Vector3f*, Neighbours::kMost> found;
  int size = 0;
  auto worst = static_cast<float>(max_distance * max_distance);
  for (int64_t x = centre.x() - 1; x <= centre.x() + 1; ++x) {
    for (int64_t y = centre.y() - 1; y <= centre.y() + 1; ++y) {
      for (int64_t z = centre.z() - 1; z <= centre.z() + 1; ++z) {
        const uint32_t* const voxel = Find(PackVoxel(x, y, z));
        if (voxel == nullptr) continue;
        const Eigen::Vector3f* const begin = points_.data() + *voxel * most;
        for (const Eigen::Vector3f* point = begin; point != begin + counts_[*voxel]; ++point) {
          const float distance = (*point - query_float).squaredNorm();
          if (distance >= worst) continue;
          int place = size < count ? size++ : size - 1;
          for (; place > 0 && distances[static_cast<size_t>(place - 1)] > distance; --place) {
            distances[static_cast<size_t>(place)] = distances[static_cast<size_t>(place - 1)];
            found[static_cast<size_t>(place)] = found[static_cast<size_t>(place - 1)];
          }
          distances[static_cast<size_t>(place)] = distance;
          found[static_cast<size_t>(place)] = point;
          if (size == count) worst = distances[static_cast<size_t>(count - 1)];
        }
      }
    }
  }
  Neighbours neighbours;
  neighbours.count = size;
  for (size_t i = 0; i < static_cast<size_t>(size); ++i) {
    neighbours.points[i] = found[i]->cast<double>();
    neighbours.squared_distances[i] = static_cast<double>(distances[i]);
  }
  return neighbours;
}

std::vector<Eigen::Vector3d> VoxelMap::Points() const {
  const auto most = static_cast<size_t>(options_.max_points_per_voxel);
  std::vector<Eigen::Vector3d> all;
  for (size_t voxel = 0; voxel < keys_.size(); ++voxel) {
    for (size_t i = 0; i < counts_[voxel]; ++i) {
      all.push_back(points_[voxel * most + i].cast<double>());
    }
  }
  return all;
}

size_t VoxelMap::SlotOf(VoxelKey key) const {
  const size_t mask = slots_.size() - 1;
  size_t slot = Scramble(key) & mask;
  while (slots_[slot] != kEmptySlot && keys_[slots_[slot]] != key) slot = (slot + 1) & mask;
  return slot;
}

const uint32_t* VoxelMap::Find(VoxelKey key) const {
  const uint32_t& slot = slots_[SlotOf(key)];
  return slot == kEmptySlot ? nullptr : &slot;
}

uint32_t VoxelMap::FindOrInsert(VoxelKey key) {
  if (2 * (keys_.size() + 1) > slots_.size()) Rehash(2 * slots_.size());
  uint32_t& slot = slots_[SlotOf(key)];
  if (slot == kEmptySlot) {
    slot = static_cast<uint32_t>(keys_.size());
    keys_.push_back(key);
    counts_.push_back(0);
    points_.resize(points_.size() + static_cast<size_t>(options_.max_points_per_voxel));
  }
  return slot;
}

void VoxelMap::Rehash(size_t slots) {
  slots_.assign(slots, kEmptySlot);
  for (size_t voxel = 0; voxel < keys_.size(); ++voxel) {
    slots_[SlotOf(keys_[voxel])] = static_cast<uint32_t>(voxel);
  }
}

}  // namespace regolith
