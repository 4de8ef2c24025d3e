// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/point_to_plane.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

bool IsPlane(const PlaneFit& plane, const PointToPlaneOptions& options) {
  const Eigen::Vector3d spread = plane.variances.cwiseSqrt();
  return spread[0] <= options.max_thickness_ratio * spread[1] &&
         spread[1] >= options.min_width_ratio * spread[2];
}

PlaneMatch FindPlane(const Eigen::Vector3d& point_map, Span<const VoxelMap> maps,
                     const PointToPlaneOptions& options) {
  for (const VoxelMap& map : maps) {
    const Neighbours neighbours = map.Nearest(point_map, options.neighbours, map.voxel_size());
    if (neighbours.count < options.min_neighbours) continue;
    const PlaneFit plane = FitPlane(neighbours.Points());
    if (IsPlane(plane, options)) return {true, plane.centroid, plane.normal, plane.variances[0]};
  }
  return {};
}

double RobustScale(std::vector<double> magnitudes, double floor) {
  if (magnitudes.empty()) return floor;
  const auto middle = magnitudes.begin() + static_cast<ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  return std::max(floor, kMedianToSigma * *middle);
}

// d r / d rotation = nᵀ d(R Exp(φ) p) = (p × Rᵀ n)ᵀ.
Vector6d Jacobian(const Eigen::Vector3d& point_body, const Eigen::Vector3d& normal,
                  const SE3& T_map_body) {
  Vector6d jacobian;
  jacobian << point_body.cross(T_map_body.rotation.conjugate() * normal), normal;
  return jacobian;
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

std::vector<PlaneMatch> FindPlanes(Span<const Eigen::Vector3d> points_body, const SE3& T_map_body,
                                   Span<const VoxelMap> maps, const PointToPlaneOptions& options,
                                   ThreadPool* threads) {
  std::vector<PlaneMatch> planes(points_body.size());
  threads->ParallelFor(points_body.size(), kChunkSize, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      planes[i] = FindPlane(T_map_body * points_body[i], maps, options);
    }
  });
  return planes;
}

PointToPlaneSystem LinearizePointToPlane(Span<const Eigen::Vector3d> points_body,
                                         Span<const PlaneMatch> planes, const SE3& T_map_body,
                                         const PointToPlaneOptions& options) {
  REGOLITH_CHECK(points_body.size() == planes.size(), points_body.size(), " points and ",
                 planes.size(), " planes");
  std::vector<double> residuals(points_body.size());
  std::vector<double> magnitudes;
  for (size_t i = 0; i < points_body.size(); ++i) {
    if (!planes[i].valid) continue;
    residuals[i] = planes[i].normal.dot(T_map_body * points_body[i] - planes[i].centroid);
    magnitudes.push_back(std::abs(residuals[i]));
  }
  PointToPlaneSystem system;
  system.points = static_cast<int>(points_body.size());
  system.matches = static_cast<int>(magnitudes.size());
  system.scale = RobustScale(std::move(magnitudes), options.range_sigma);
  const double kernel = kKernelSigmas * system.scale;
  const double variance = system.scale * system.scale;
  for (size_t i = 0; i < points_body.size(); ++i) {
    if (!planes[i].valid) continue;
    const double ratio = residuals[i] / kernel;
    const double root = 1.0 / (1.0 + ratio * ratio);
    const double weight = root * root;
    const double precision =
        options.independence * weight / (variance + planes[i].thickness_squared);
    const Vector6d jacobian = Jacobian(points_body[i], planes[i].normal, T_map_body);
    system.information.noalias() += precision * jacobian * jacobian.transpose();
    system.gradient += precision * residuals[i] * jacobian;
    system.inliers += weight;
  }
  return system;
}

}  // namespace regolith
