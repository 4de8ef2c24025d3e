// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/local_map.h"

#include <algorithm>

#include "regolith/cloud/downsample.h"
#include "regolith/lio/range_jumps.h"

namespace regolith {
namespace {

std::vector<Eigen::Vector3d> Picked(const std::vector<Eigen::Vector3d>& points,
                                    const std::vector<uint32_t>& indices) {
  std::vector<Eigen::Vector3d> picked;
  picked.reserve(indices.size());
  for (const uint32_t index : indices) picked.push_back(points[index]);
  return picked;
}

}  // namespace

LocalMap::LocalMap(const LidarOdometryOptions& options, int rings)
    : options_(options), rings_(rings) {
  Clear();
}

void LocalMap::Clear() {
  is_new_ = true;
  voxels_.clear();
  features_.reset();
  if (options_.features) {
    if (rings_ > 0) features_.emplace(options_.feature_matcher, rings_);
    return;
  }
  VoxelMapOptions level = options_.map;
  for (int i = 0; i < options_.map_levels; ++i, level.voxel_size *= options_.map_growth) {
    voxels_.emplace_back(level);
  }
}

double LocalMap::ShareAtJumps() const {
  if (points_ == 0) return 0.0;
  return 1.0 - static_cast<double>(solid_points_) / static_cast<double>(points_);
}

ScanMatch LocalMap::Match(const LidarScan& scan, const std::vector<Eigen::Vector3d>& points_body,
                          const SE3& prior, const Matrix6d& prior_covariance, ThreadPool* threads) {
  if (features_) return features_->Match(scan, points_body, prior, prior_covariance, threads);
  solid_ = PointsOffRangeJumps(scan, options_.range_jumps);
  points_ += scan.points.size();
  solid_points_ += solid_.size();
  const std::vector<Eigen::Vector3d> solid = Picked(points_body, solid_);
  const std::vector<uint32_t> kept = DownsampleIndices(solid, options_.scan_voxel_size);
  const size_t count = std::min(kept.size(), static_cast<size_t>(options_.max_points));
  std::vector<Eigen::Vector3d> thinned(count);
  for (size_t i = 0; i < count; ++i) thinned[i] = solid[kept[i * kept.size() / count]];
  return MatchScan(thinned, prior, prior_covariance, voxels_, options_.matcher, threads);
}

void LocalMap::Extend(const std::vector<Eigen::Vector3d>& points_map, const SE3& T_map_body) {
  if (!points_map.empty()) is_new_ = false;
  if (features_) features_->Extend(T_map_body);
  const std::vector<Eigen::Vector3d> solid = Picked(points_map, solid_);
  for (VoxelMap& map : voxels_) {
    map.Add(solid, T_map_body.translation);
    map.ForgetSomeFarFrom(T_map_body.translation);
  }
}

}  // namespace regolith
