// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/voxel_map.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

// The 27 voxels around a query, its own first: near points found early let most of the others be
// skipped.
constexpr std::array<std::array<int, 3>, 27> NeighbourOffsets() {
  std::array<std::array<int, 3>, 27> offsets{};
  size_t place = 0;
  for (int distance = 0; distance <= 3; ++distance) {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (x * x + y * y + z * z == distance) offsets[place++] = {x, y, z};
        }
      }
    }
  }
  return offsets;
}

constexpr auto kNeighbourOffsets = NeighbourOffsets();

/// The nearest points so far, sorted by distance.
class NearestList {
 public:
  NearestList(int count, float worst) : count_(static_cast<size_t>(count)), worst_(worst) {}

  float worst() const { return worst_; }

  void Offer(float squared_distance, const Eigen::Vector3f* point) {
    if (squared_distance >= worst_) return;
    size_t place = size_ < count_ ? size_++ : size_ - 1;
    for (; place > 0 && distances_[place - 1] > squared_distance; --place) {
      distances_[place] = distances_[place - 1];
      points_[place] = points_[place - 1];
    }
    distances_[place] = squared_distance;
    points_[place] = point;
    if (size_ == count_) worst_ = distances_[count_ - 1];
  }

  Neighbours Result() const {
    Neighbours neighbours;
    neighbours.count = static_cast<int>(size_);
    for (size_t i = 0; i < size_; ++i) {
      neighbours.points[i] = points_[i]->cast<double>();
      neighbours.squared_distances[i] = static_cast<double>(distances_[i]);
    }
    return neighbours;
  }

 private:
  size_t count_;
  float worst_;
  size_t size_ = 0;
  std::array<float, Neighbours::kMost> distances_;
  std::array<const Eigen::Vector3f*, Neighbours::kMost> points_;
};

}  // namespace

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
  // Distance to the nearer and to the farther neighbouring voxel along each axis, squared.
  const Eigen::Vector3d inside = query - options_.voxel_size * centre.cast<double>();
  const Eigen::Array3f below = inside.array().square().cast<float>();
  const Eigen::Array3f above = (options_.voxel_size - inside.array()).square().cast<float>();
  NearestList nearest(count, static_cast<float>(max_distance * max_distance));
  for (const auto& [x, y, z] : kNeighbourOffsets) {
    const float gap = (x < 0   ? below[0]
                       : x > 0 ? above[0]
                               : 0.0F) +
                      (y < 0   ? below[1]
                       : y > 0 ? above[1]
                               : 0.0F) +
                      (z < 0   ? below[2]
                       : z > 0 ? above[2]
                               : 0.0F);
    if (gap >= nearest.worst()) continue;
    const uint32_t* const voxel = Find(PackVoxel(centre.x() + x, centre.y() + y, centre.z() + z));
    if (voxel == nullptr) continue;
    const Eigen::Vector3f* const begin = points_.data() + *voxel * most;
    for (const Eigen::Vector3f* point = begin; point != begin + counts_[*voxel]; ++point) {
      nearest.Offer((*point - query_float).squaredNorm(), point);
    }
  }
  return nearest.Result();
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
