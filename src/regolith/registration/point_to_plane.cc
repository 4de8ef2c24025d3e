// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/point_to_plane.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "regolith/cloud/plane_fit.h"
#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr size_t kChunkSize = 128;
// Makes the median of |r| a standard deviation for Gaussian r.
constexpr double kMedianToSigma = 1.4826;
// Residuals beyond a few standard deviations lose their weight.
constexpr double kKernelSigmas = 3.0;

struct Match {
  bool valid = false;
  double residual = 0.0;
  double thickness_squared = 0.0;  ///< m², of the neighbourhood across its plane
  Vector6d jacobian = Vector6d::Zero();
};

bool IsPlane(const PlaneFit& plane, const PointToPlaneOptions& options) {
  const Eigen::Vector3d spread = plane.variances.cwiseSqrt();
  return spread[0] <= options.max_thickness_ratio * spread[1] &&
         spread[1] >= options.min_width_ratio * spread[2];
}

std::optional<PlaneFit> FindPlane(const Eigen::Vector3d& point_map, Span<const VoxelMap> maps,
                                  const PointToPlaneOptions& options) {
  for (const VoxelMap& map : maps) {
    const Neighbours neighbours = map.Nearest(point_map, options.neighbours, map.voxel_size());
    if (neighbours.count < options.min_neighbours) continue;
    const PlaneFit plane = FitPlane(neighbours.Points());
    if (IsPlane(plane, options)) return plane;
  }
  return std::nullopt;
}

Match MatchPoint(const Eigen::Vector3d& point_body, const SE3& T_map_body,
                 Span<const VoxelMap> maps, const PointToPlaneOptions& options) {
  Match match;
  const Eigen::Vector3d point_map = T_map_body * point_body;
  const std::optional<PlaneFit> plane = FindPlane(point_map, maps, options);
  if (!plane) return match;
  match.valid = true;
  match.residual = plane->normal.dot(point_map - plane->centroid);
  match.thickness_squared = plane->variances[0];
  // d r / d rotation = nᵀ d(R Exp(φ) p) = (p × Rᵀ n)ᵀ.
  const Eigen::Vector3d normal_body = T_map_body.rotation.conjugate() * plane->normal;
  match.jacobian << point_body.cross(normal_body), plane->normal;
  return match;
}

double RobustScale(const std::vector<Match>& matches, double floor) {
  std::vector<double> magnitudes;
  for (const Match& match : matches) {
    if (match.valid) magnitudes.push_back(std::abs(match.residual));
  }
  if (magnitudes.empty()) return floor;
  const auto middle = magnitudes.begin() + static_cast<ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  return std::max(floor, kMedianToSigma * *middle);
}

}  // namespace

void PointToPlaneOptions::Check() const {
  REGOLITH_CHECK(neighbours >= 3 && neighbours <= Neighbours::kMost, "neighbours=", neighbours);
  REGOLITH_CHECK(min_neighbours >= 3 && min_neighbours <= neighbours,
                 "min_neighbours=", min_neighbours);
  REGOLITH_CHECK(max_thickness_ratio > 0.0, "max_thickness_ratio=", max_thickness_ratio);
  REGOLITH_CHECK(min_width_ratio >= 0.0 && min_width_ratio < 1.0,
                 "min_width_ratio=", min_width_ratio);
  REGOLITH_CHECK(range_sigma > 0.0, "range_sigma=", range_sigma);
  REGOLITH_CHECK(independence > 0.0 && independence <= 1.0, "independence=", independence);
}

PointToPlaneSystem LinearizePointToPlane(Span<const Eigen::Vector3d> points_body,
                                         const SE3& T_map_body, Span<const VoxelMap> maps,
                                         const PointToPlaneOptions& options, ThreadPool* threads) {
  std::vector<Match> matches(points_body.size());
  threads->ParallelFor(points_body.size(), kChunkSize, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      matches[i] = MatchPoint(points_body[i], T_map_body, maps, options);
    }
  });
  PointToPlaneSystem system;
  system.points = static_cast<int>(points_body.size());
  system.scale = RobustScale(matches, options.range_sigma);
  const double kernel = kKernelSigmas * system.scale;
  const double variance = system.scale * system.scale;
  for (const Match& match : matches) {
    if (!match.valid) continue;
    const double ratio = match.residual / kernel;
    const double root = 1.0 / (1.0 + ratio * ratio);
    const double weight = root * root;
    const double precision = options.independence * weight / (variance + match.thickness_squared);
    system.information.noalias() += precision * match.jacobian * match.jacobian.transpose();
    system.gradient += precision * match.residual * match.jacobian;
    system.inliers += weight;
    ++system.matches;
  }
  return system;
}

}  // namespace regolith
