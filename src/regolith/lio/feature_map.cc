// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/feature_map.h"

#include <algorithm>
#include <cmath>

#include "regolith/cloud/plane_fit.h"
#include "regolith/core/check.h"
#include "regolith/registration/robust_scale.h"

namespace regolith {
namespace {

constexpr size_t kChunkSize = 64;

/// Voxels as wide as the search, with points as far apart as asked for on a surface.
VoxelMapOptions MapOptions(double voxel_size, double spacing, double radius) {
  VoxelMapOptions options;
  options.voxel_size = voxel_size;
  options.max_points_per_voxel =
      std::max(1, static_cast<int>(std::lround(std::pow(voxel_size / spacing, 2))));
  options.radius = radius;
  return options;
}

std::vector<VoxelMap> PlanarMaps(const FeatureMapOptions& options) {
  const double fine = options.search_distance;
  const double coarse = fine * options.coarse_growth;
  std::vector<VoxelMap> maps;
  maps.emplace_back(MapOptions(fine, options.planar_spacing, options.radius));
  maps.emplace_back(
      MapOptions(coarse, options.planar_spacing * options.coarse_growth, options.radius));
  return maps;
}

std::vector<Eigen::Vector3d> Transformed(const SE3& T_target_source,
                                         Span<const Eigen::Vector3d> points_source) {
  std::vector<Eigen::Vector3d> points_target;
  points_target.reserve(points_source.size());
  for (const Eigen::Vector3d& point : points_source) {
    points_target.push_back(T_target_source * point);
  }
  return points_target;
}

}  // namespace

void FeatureMapOptions::Check() const {
  REGOLITH_CHECK(edge_spacing > 0.0, "edge_spacing=", edge_spacing);
  REGOLITH_CHECK(planar_spacing > 0.0, "planar_spacing=", planar_spacing);
  REGOLITH_CHECK(search_distance > std::max(edge_spacing, planar_spacing),
                 "search_distance=", search_distance);
  REGOLITH_CHECK(radius > search_distance * coarse_growth, "radius=", radius);
  REGOLITH_CHECK(coarse_growth > 1.0, "coarse_growth=", coarse_growth);
  REGOLITH_CHECK(neighbours >= 3 && neighbours <= Neighbours::kMost, "neighbours=", neighbours);
  REGOLITH_CHECK(line_ratio > 1.0, "line_ratio=", line_ratio);
  REGOLITH_CHECK(plane_thickness > 0.0, "plane_thickness=", plane_thickness);
  REGOLITH_CHECK(plane_ratio >= 0.0 && plane_ratio < 1.0, "plane_ratio=", plane_ratio);
  REGOLITH_CHECK(range_sigma > 0.0, "range_sigma=", range_sigma);
  REGOLITH_CHECK(max_searches > 0, "max_searches=", max_searches);
  REGOLITH_CHECK(steps_per_search > 0, "steps_per_search=", steps_per_search);
  REGOLITH_CHECK(min_matches > 0, "min_matches=", min_matches);
  REGOLITH_CHECK(min_eigenvalue >= 0.0, "min_eigenvalue=", min_eigenvalue);
}

FeatureMap::FeatureMap(const FeatureMapOptions& options)
    : options_(options),
      edges_(MapOptions(options.search_distance, options.edge_spacing, options.radius)),
      planars_(PlanarMaps(options)) {
  options.Check();
}

void FeatureMap::Add(const FeatureCloud& cloud_lidar, const SE3& T_map_lidar) {
  const Eigen::Vector3d& centre = T_map_lidar.translation;
  edges_.Add(Transformed(T_map_lidar, cloud_lidar.edges), centre);
  const auto planars_map = Transformed(T_map_lidar, cloud_lidar.planars);
  for (VoxelMap& map : planars_) map.Add(planars_map, centre);
}

void FeatureMap::ForgetFarFrom(const Eigen::Vector3d& centre) {
  edges_.ForgetFarFrom(centre);
  for (VoxelMap& map : planars_) map.ForgetFarFrom(centre);
}

FeatureLine FeatureMap::FindLine(const Eigen::Vector3d& point_map) const {
  const Neighbours found = edges_.Nearest(point_map, options_.neighbours, options_.search_distance);
  if (found.count < options_.neighbours) return {};
  const PlaneFit fit = FitPlane(found.Points());
  if (!(fit.variances[2] > options_.line_ratio * fit.variances[1])) return {};
  return {true, fit.centroid, fit.axes.col(2)};
}

FeaturePlane FeatureMap::FindPlane(const Eigen::Vector3d& point_map) const {
  double growth = 1.0;
  for (const VoxelMap& map : planars_) {
    const Neighbours found = map.Nearest(point_map, options_.neighbours, map.voxel_size());
    if (found.count == options_.neighbours) {
      const PlaneFit fit = FitPlane(found.Points());
      const double limit = growth * options_.plane_thickness;
      const auto points = found.Points();
      const bool is_flat =
          std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
            return std::abs(fit.normal.dot(point - fit.centroid)) < limit;
          });
      const bool is_wide = fit.variances[1] > options_.plane_ratio * fit.variances[2];
      if (is_flat && is_wide) return {true, fit.centroid, fit.normal};
    }
    growth = options_.coarse_growth;
  }
  return {};
}

FeatureMatches FeatureMap::Search(const FeatureCloud& cloud_lidar, const SE3& T_map_lidar,
                                  ThreadPool* threads) const {
  FeatureMatches matches;
  matches.edges = cloud_lidar.edges;
  matches.lines.resize(matches.edges.size());
  matches.planars = cloud_lidar.planars;
  matches.planes.resize(matches.planars.size());
  const auto find = [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      if (i < matches.edges.size()) {
        matches.lines[i] = FindLine(T_map_lidar * matches.edges[i]);
      } else {
        const size_t planar = i - matches.edges.size();
        matches.planes[planar] = FindPlane(T_map_lidar * matches.planars[planar]);
      }
    }
  };
  threads->ParallelFor(matches.edges.size() + matches.planars.size(), kChunkSize, find);
  return matches;
}

MapMatch FeatureMap::Match(const FeatureCloud& cloud_lidar, const SE3& T_map_lidar_guess,
                           ThreadPool* threads) const {
  MapMatch match;
  match.T_map_lidar = T_map_lidar_guess;
  for (int search = 0; search < options_.max_searches; ++search) {
    const SE3 before = match.T_map_lidar;
    const FeatureMatches matches = Search(cloud_lidar, before, threads);
    match.scale = RobustScale(matches, before, options_.range_sigma);
    const double kernel = kKernelSigmas * match.scale;
    match.system = Linearize(matches, before, kernel);
    if (match.system.matches < options_.min_matches) {
      match.T_map_lidar = T_map_lidar_guess;
      match.degenerate_directions = 6;
      return match;
    }
    const MotionSubspace subspace =
        RemoveDegenerate(match.system, {Matrix6d::Identity(), kTypicalRange},
                         options_.min_eigenvalue, &match.degenerate_directions);
    match.T_map_lidar =
        MinimizeDistances(matches, before, subspace, kernel, options_.steps_per_search);
    if (HasConverged(before, match.T_map_lidar, options_.rotation_tolerance,
                     options_.position_tolerance)) {
      break;
    }
  }
  match.used_scan = true;
  return match;
}

}  // namespace regolith
