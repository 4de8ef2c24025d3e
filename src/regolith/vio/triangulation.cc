// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/triangulation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace regolith {
namespace {

/// Rays that span less than this (sine of an angle squared, summed) have no common point.
constexpr double kParallel = 1e-7;

}  // namespace

std::optional<TriangulatedPoint> Triangulate(const std::vector<PointView>& views) {
  TriangulatedPoint result;
  std::vector<double> distances(views.size(), 1.0);
  for (int round = 0; round < 2; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (size_t i = 0; i < views.size(); ++i) {
      const Eigen::Vector3d ray = views[i].T_world_camera.rotation * views[i].bearing;
      const double weight = 1.0 / (distances[i] * distances[i]);
      const Eigen::Matrix3d across = weight * (Eigen::Matrix3d::Identity() - ray * ray.transpose());
      normal += across;
      right += across * views[i].T_world_camera.translation;
      weights += weight;
    }
    normal /= weights;
    if (normal.determinant() < kParallel) return std::nullopt;
    result.point_world = normal.ldlt().solve(right / weights);
    for (size_t i = 0; i < views.size(); ++i) {
      const Eigen::Vector3d point_camera = views[i].T_world_camera.Inverse() * result.point_world;
      distances[i] = point_camera.norm();
      if (point_camera.dot(views[i].bearing) <= 0.0 || distances[i] < 1e-6) return std::nullopt;
    }
  }
  const Eigen::Vector3d first =
      (result.point_world - views.front().T_world_camera.translation).normalized();
  for (const PointView& view : views) {
    const Eigen::Vector3d other =
        (result.point_world - view.T_world_camera.translation).normalized();
    result.parallax = std::max(result.parallax, std::acos(std::clamp(first.dot(other), -1.0, 1.0)));
  }
  return result;
}

}  // namespace regolith
