// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/point_to_plane.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "regolith/cloud/plane_fit.h"
#include "regolith/core/check.h"
#include "regolith/registration/robust_scale.h"

namespace regolith {
namespace {

constexpr size_t kChunkSize = 128;
constexpr size_t kSumChunkSize = 512;
// A piece of one ring is as wide as the range's noise makes it, and that lies along the beam: the
// plane through it leans towards the sensor.
constexpr double kWidthSigmas = 3.0;
// rad; beyond it the small-angle model says nothing.
constexpr double kMostNormalError = 1.0;

bool IsPlane(const PlaneFit& plane, const PointToPlaneOptions& options) {
  const Eigen::Vector3d spread = plane.variances.cwiseSqrt();
  return spread[0] <= options.max_thickness_ratio * spread[1] &&
         spread[1] >= options.min_width_ratio * spread[2] &&
         spread[1] >= kWidthSigmas * options.range_sigma;
}

// The error of a fitted normal along an axis within the plane: that of a regression's slope. Over
// the neighbourhoods of a plane that pass IsPlane, noise and information made of it are then equal
// (tests); with the unbiased variance of the residuals noise would be half as much again.
Eigen::Vector3d NormalError(const PlaneFit& plane, int axis, int count) {
  const double slope =
      std::sqrt(plane.variances[0] / (static_cast<double>(count) * plane.variances[axis]));
  return std::min(slope, kMostNormalError) * plane.axes.col(axis);
}

PlaneMatch FindPlane(const Eigen::Vector3d& point_map, Span<const VoxelMap> maps,
                     const PointToPlaneOptions& options) {
  PlaneMatch match;
  match.searched = true;
  match.searched_at = point_map;
  for (const VoxelMap& map : maps) {
    const Neighbours neighbours = map.Nearest(point_map, options.neighbours, map.voxel_size());
    if (neighbours.count < options.min_neighbours) continue;
    const PlaneFit plane = FitPlane(neighbours.Points());
    if (!IsPlane(plane, options)) continue;
    match.valid = true;
    match.centroid = plane.centroid;
    match.normal = plane.normal;
    match.thickness_squared = plane.variances[0];
    match.normal_error_minor = NormalError(plane, 1, neighbours.count);
    match.normal_error_major = NormalError(plane, 2, neighbours.count);
    break;
  }
  return match;
}

// d r / d rotation = nᵀ d(R Exp(φ) p) = (p × Rᵀ n)ᵀ.
Vector6d Jacobian(const Eigen::Vector3d& point_body, const Eigen::Vector3d& normal,
                  const SE3& T_map_body) {
  Vector6d jacobian;
  jacobian << point_body.cross(T_map_body.rotation.conjugate() * normal), normal;
  return jacobian;
}

/// Sums over a chunk of points.
struct PartialSystem {
  Matrix6d information = Matrix6d::Zero();
  Matrix6d noise = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double inliers = 0.0;
};

PartialSystem SumOver(size_t begin, size_t end, Span<const Eigen::Vector3d> points_body,
                      Span<const PlaneMatch> planes, Span<const double> residuals,
                      const SE3& T_map_body, double scale, const PointToPlaneOptions& options) {
  PartialSystem sum;
  const double kernel = kKernelSigmas * scale;
  for (size_t i = begin; i < end; ++i) {
    const PlaneMatch& plane = planes[i];
    if (!plane.valid) continue;
    const double ratio = residuals[i] / kernel;
    const double root = 1.0 / (1.0 + ratio * ratio);
    const double weight = root * root;
    const double precision =
        options.independence * weight / (scale * scale + plane.thickness_squared);
    const Vector6d jacobian = Jacobian(points_body[i], plane.normal, T_map_body);
    sum.information.noalias() += (precision * jacobian) * jacobian.transpose();
    sum.gradient += (precision * residuals[i]) * jacobian;
    sum.inliers += weight;
    for (const Eigen::Vector3d& error : {plane.normal_error_minor, plane.normal_error_major}) {
      const Vector6d spurious = Jacobian(points_body[i], error, T_map_body);
      sum.noise.noalias() += (precision * spurious) * spurious.transpose();
    }
  }
  return sum;
}

}  // namespace

void PointToPlaneOptions::Check() const {
  REGOLITH_CHECK(neighbours >= 3 && neighbours <= Neighbours::kMost, "neighbours=", neighbours);
  REGOLITH_CHECK(min_neighbours >= 4 && min_neighbours <= neighbours,
                 "min_neighbours=", min_neighbours);
  REGOLITH_CHECK(max_thickness_ratio > 0.0, "max_thickness_ratio=", max_thickness_ratio);
  REGOLITH_CHECK(min_width_ratio >= 0.0 && min_width_ratio < 1.0,
                 "min_width_ratio=", min_width_ratio);
  REGOLITH_CHECK(search_again_distance >= 0.0, "search_again_distance=", search_again_distance);
  REGOLITH_CHECK(range_sigma > 0.0, "range_sigma=", range_sigma);
  REGOLITH_CHECK(independence > 0.0 && independence <= 1.0, "independence=", independence);
}

void FindPlanes(Span<const Eigen::Vector3d> points_body, const SE3& T_map_body,
                Span<const VoxelMap> maps, const PointToPlaneOptions& options, ThreadPool* threads,
                std::vector<PlaneMatch>* planes) {
  planes->resize(points_body.size());
  const double squared_distance = options.search_again_distance * options.search_again_distance;
  threads->ParallelFor(points_body.size(), kChunkSize, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      PlaneMatch& plane = (*planes)[i];
      const Eigen::Vector3d point_map = T_map_body * points_body[i];
      if (plane.searched && (point_map - plane.searched_at).squaredNorm() <= squared_distance) {
        continue;
      }
      plane = FindPlane(point_map, maps, options);
    }
  });
}

PointToPlaneSystem LinearizePointToPlane(Span<const Eigen::Vector3d> points_body,
                                         Span<const PlaneMatch> planes, const SE3& T_map_body,
                                         const PointToPlaneOptions& options, ThreadPool* threads) {
  REGOLITH_CHECK(points_body.size() == planes.size(), points_body.size(), " points and ",
                 planes.size(), " planes");
  std::vector<double> residuals(points_body.size());
  std::vector<double> magnitudes;
  magnitudes.reserve(points_body.size());
  for (size_t i = 0; i < points_body.size(); ++i) {
    if (!planes[i].valid) continue;
    residuals[i] = planes[i].normal.dot(T_map_body * points_body[i] - planes[i].centroid);
    magnitudes.push_back(std::abs(residuals[i]));
  }
  PointToPlaneSystem system;
  system.points = static_cast<int>(points_body.size());
  system.matches = static_cast<int>(magnitudes.size());
  system.scale = RobustScale(std::move(magnitudes), options.range_sigma);
  std::vector<PartialSystem> sums(ChunkCount(points_body.size(), kSumChunkSize));
  threads->ParallelFor(
      points_body.size(), kSumChunkSize, [&](size_t begin, size_t end, size_t chunk) {
        sums[chunk] =
            SumOver(begin, end, points_body, planes, residuals, T_map_body, system.scale, options);
      });
  for (const PartialSystem& sum : sums) {
    system.information += sum.information;
    system.noise += sum.noise;
    system.gradient += sum.gradient;
    system.inliers += sum.inliers;
  }
  return system;
}

}  // namespace regolith
