// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/voxel_map.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"

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

/// The nearest points so far, sorted by distance. A point is a voxel's number and its place there.
class NearestList {
 public:
  struct Entry {
    float squared_distance;
    uint32_t voxel;
    uint32_t place;
  };

  NearestList(int count, float worst) : count_(static_cast<size_t>(count)), worst_(worst) {}

  float worst() const { return worst_; }
  size_t size() const { return size_; }
  const Entry& operator[](size_t i) const { return entries_[i]; }

  void Offer(float squared_distance, uint32_t voxel, uint32_t index) {
    if (squared_distance >= worst_) return;
    size_t place = size_ < count_ ? size_++ : size_ - 1;
    for (; place > 0 && entries_[place - 1].squared_distance > squared_distance; --place) {
      entries_[place] = entries_[place - 1];
    }
    entries_[place] = {squared_distance, voxel, index};
    if (size_ == count_) worst_ = entries_[count_ - 1].squared_distance;
  }

 private:
  size_t count_;
  float worst_;
  size_t size_ = 0;
  std::array<Entry, Neighbours::kMost> entries_;
};

// Points that one step of the search compares at once.
constexpr size_t kLane = 8;
using Lane = Eigen::Array<float, kLane, 1>;
using LaneMap = Eigen::Map<const Lane>;

// Shares of the map that ForgetSomeFarFrom looks at, one a call.
constexpr size_t kShares = 16;
// What the radius is multiplied by where memory is short.
constexpr double kShrinkage = 0.9;

}  // namespace

void VoxelMapOptions::Check() const {
  REGOLITH_CHECK(voxel_size > 0.0, "voxel_size=", voxel_size);
  REGOLITH_CHECK(max_points_per_voxel > 0 && max_points_per_voxel < 1000,
                 "max_points_per_voxel=", max_points_per_voxel);
  REGOLITH_CHECK(radius > voxel_size, "radius=", radius);
  REGOLITH_CHECK(max_voxels >= 1000 && max_voxels <= 100000000, "max_voxels=", max_voxels);
}

VoxelMap::VoxelMap(const VoxelMapOptions& options)
    : options_(options),
      inverse_size_(1.0 / options.voxel_size),
      radius_(options.radius),
      lanes_((static_cast<size_t>(options.max_points_per_voxel) + kLane - 1) / kLane * kLane),
      table_(static_cast<size_t>(options.max_voxels)) {
  options.Check();
  // As many points as fit cover a square of the voxel's face evenly: surfaces, not volumes, are
  // mapped.
  squared_spacing_ =
      static_cast<float>(options.voxel_size * options.voxel_size / options.max_points_per_voxel);
  keys_.reserve(static_cast<size_t>(options.max_voxels));
  counts_.reserve(static_cast<size_t>(options.max_voxels));
}

void VoxelMap::Add(Span<const Eigen::Vector3d> points, const Eigen::Vector3d& centre) {
  const auto most = static_cast<size_t>(options_.max_points_per_voxel);
  for (const Eigen::Vector3d& point : points) {
    if ((point - centre).squaredNorm() > radius_ * radius_) continue;
    const uint32_t voxel = FindOrInsert(KeyOf(point, inverse_size_), centre);
    const size_t count = counts_[voxel];
    if (count >= most) continue;
    const Eigen::Vector3f added = point.cast<float>();
    float* const x = Coordinates(voxel);
    float* const y = x + lanes_;
    float* const z = y + lanes_;
    bool crowded = false;
    for (size_t i = 0; i < count && !crowded; ++i) {
      crowded = (Eigen::Vector3f(x[i], y[i], z[i]) - added).squaredNorm() < squared_spacing_;
    }
    if (crowded) continue;
    x[count] = added.x();
    y[count] = added.y();
    z[count] = added.z();
    ++counts_[voxel];
  }
}

void VoxelMap::ForgetSomeFarFrom(const Eigen::Vector3d& centre) {
  const size_t share = keys_.size() / kShares + 1;
  const size_t end = std::min(keys_.size(), next_to_look_at_ + share);
  Forget(next_to_look_at_, end, centre);
  next_to_look_at_ = end == keys_.size() ? 0 : end;
}

void VoxelMap::ForgetFarFrom(const Eigen::Vector3d& centre) { Forget(0, keys_.size(), centre); }

void VoxelMap::Forget(size_t begin, size_t end, const Eigen::Vector3d& centre) {
  const Eigen::Vector3f near = centre.cast<float>();
  const auto squared_radius = static_cast<float>(radius_ * radius_);
  for (size_t voxel = begin; voxel < end; ++voxel) {
    if (counts_[voxel] == 0) continue;
    if ((PointAt(voxel, 0) - near).squaredNorm() > squared_radius) Erase(voxel);
  }
}

Neighbours VoxelMap::Nearest(const Eigen::Vector3d& query, int count, double max_distance) const {
  REGOLITH_CHECK(count > 0 && count <= Neighbours::kMost, "count=", count);
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
    const VoxelKey key = PackVoxel(centre.x() + x, centre.y() + y, centre.z() + z);
    const uint32_t voxel = table_.Find(key, KeyAt());
    if (voxel == VoxelTable::kNone) continue;
    const float* const coordinates = Coordinates(voxel);
    const size_t held = counts_[voxel];
    for (size_t first = 0; first < held; first += kLane) {
      const float* const lane = coordinates + first;
      const Lane squared = (LaneMap(lane) - query_float.x()).square() +
                           (LaneMap(lane + lanes_) - query_float.y()).square() +
                           (LaneMap(lane + 2 * lanes_) - query_float.z()).square();
      const size_t filled = std::min(kLane, held - first);
      for (size_t i = 0; i < filled; ++i) {
        nearest.Offer(squared[static_cast<Eigen::Index>(i)], voxel,
                      static_cast<uint32_t>(first + i));
      }
    }
  }
  Neighbours neighbours;
  neighbours.count = static_cast<int>(nearest.size());
  for (size_t i = 0; i < nearest.size(); ++i) {
    neighbours.points[i] = PointAt(nearest[i].voxel, nearest[i].place).cast<double>();
    neighbours.squared_distances[i] = static_cast<double>(nearest[i].squared_distance);
  }
  return neighbours;
}

std::vector<Eigen::Vector3d> VoxelMap::Points() const {
  std::vector<Eigen::Vector3d> all;
  for (size_t voxel = 0; voxel < keys_.size(); ++voxel) {
    for (size_t i = 0; i < counts_[voxel]; ++i) all.push_back(PointAt(voxel, i).cast<double>());
  }
  return all;
}

Eigen::Vector3f VoxelMap::PointAt(size_t voxel, size_t index) const {
  const float* const x = Coordinates(voxel) + index;
  return {x[0], x[lanes_], x[2 * lanes_]};
}

uint32_t VoxelMap::FindOrInsert(VoxelKey key, const Eigen::Vector3d& centre) {
  uint32_t voxel = table_.Find(key, KeyAt());
  if (voxel != VoxelTable::kNone) return voxel;
  if (voxel_count() == static_cast<size_t>(options_.max_voxels)) MakeRoom(centre);
  voxel = NewVoxel(key);
  table_.Insert(key, voxel, KeyAt());
  return voxel;
}

uint32_t VoxelMap::NewVoxel(VoxelKey key) {
  if (!free_.empty()) {
    const uint32_t voxel = free_.back();
    free_.pop_back();
    keys_[voxel] = key;
    return voxel;
  }
  const auto voxel = static_cast<uint32_t>(keys_.size());
  if (voxel / kVoxelsPerPage == pages_.size()) {
    pages_.push_back(std::make_unique<float[]>(kVoxelsPerPage * 3 * lanes_));
  }
  keys_.push_back(key);
  counts_.push_back(0);
  return voxel;
}

void VoxelMap::MakeRoom(const Eigen::Vector3d& centre) {
  while (voxel_count() > static_cast<size_t>(0.95 * options_.max_voxels)) {
    radius_ *= kShrinkage;
    ForgetFarFrom(centre);
  }
}

void VoxelMap::Erase(size_t voxel) {
  table_.Erase(keys_[voxel], KeyAt());
  counts_[voxel] = 0;
  free_.push_back(static_cast<uint32_t>(voxel));
}

}  // namespace regolith
