// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/pose_solver.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "regolith/factors/point_projection_factor.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr int kRounds = 4;
// The last rounds trust the inliers as they are.
constexpr int kRobustRounds = 2;
constexpr int kIterations = 6;       // a round
constexpr double kNearest = 1e-3;    // m
constexpr double kConverged = 1e-7;  // rad and m
constexpr size_t kLeastSightings = 4;

struct System {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double cost = 0.0;
};

/// Half of Huber's loss of a squared error, and the weight that goes with it.
struct Loss {
  double value = 0.0;
  double weight = 1.0;

  Loss(double squared, double threshold, bool robust) : value(squared) {
    if (!robust || squared <= threshold) return;
    const double limit = std::sqrt(threshold);
    const double error = std::sqrt(squared);
    value = 2.0 * limit * error - threshold;
    weight = limit / error;
  }
};

System BuildSystem(const RectifiedCamera& camera, Span<const PointSighting> sightings,
                   const std::vector<uint8_t>& inliers, const SE3& T_world_camera, bool robust) {
  System system;
  const Eigen::Matrix3d R_camera_world = T_world_camera.rotation.conjugate().toRotationMatrix();
  for (size_t i = 0; i < sightings.size(); ++i) {
    if (inliers[i] == 0) continue;
    const PointSighting& sighting = sightings[i];
    const Eigen::Vector3d point =
        R_camera_world * (sighting.point_world - T_world_camera.translation);
    if (point.z() < kNearest) continue;
    const Eigen::Matrix3d whitening = sighting.Whitening();
    const Eigen::Vector3d error = whitening * (camera.Project(point) - sighting.seen);
    const Eigen::Matrix3d by_point = whitening * camera.ProjectionJacobian(point);
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian << by_point * Hat(point), -by_point * R_camera_world;
    const Loss loss(error.squaredNorm(), OutlierThreshold(sighting.has_right), robust);
    system.information += loss.weight * jacobian.transpose() * jacobian;
    system.gradient += loss.weight * jacobian.transpose() * error;
    system.cost += loss.value;
  }
  return system;
}

/// Levenberg–Marquardt with few iterations: the start is a prediction.
SE3 Descend(const RectifiedCamera& camera, Span<const PointSighting> sightings,
            const std::vector<uint8_t>& inliers, SE3 pose, bool robust) {
  double damping = 1e-6;
  System system = BuildSystem(camera, sightings, inliers, pose, robust);
  for (int i = 0; i < kIterations; ++i) {
    Matrix6d damped = system.information;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-9;
    const Vector6d step = -damped.ldlt().solve(system.gradient);
    if (!step.allFinite()) break;
    const SE3 moved = Plus(pose, step);
    const System next = BuildSystem(camera, sightings, inliers, moved, robust);
    if (next.cost <= system.cost) {
      pose = moved;
      system = next;
      damping *= 0.1;
      if (step.norm() < kConverged) break;
    } else {
      damping = std::max(damping * 100.0, 1e-3);
    }
  }
  return pose;
}

}  // namespace

Eigen::Matrix3d PointSighting::Whitening() const {
  Eigen::Matrix3d whitening = StereoWhitening(sigma, disparity_sigma);
  if (!has_right) whitening.row(2).setZero();
  return whitening;
}

PointSighting SightingOf(const StereoFeatures& features, size_t row,
                         const Eigen::Vector3d& point_world, const SightingNoise& noise) {
  const double sigma =
      features.patches.empty() ? noise.pixel * features.scales[row] : noise.aligned_pixel;
  return {point_world, features.Seen(row), features.HasRight(row), sigma, noise.disparity};
}

double SquaredError(const RectifiedCamera& camera, const SE3& T_camera_world,
                    const PointSighting& sighting) {
  const Eigen::Vector3d point = T_camera_world * sighting.point_world;
  if (point.z() < kNearest) return std::numeric_limits<double>::infinity();
  return (sighting.Whitening() * (camera.Project(point) - sighting.seen)).squaredNorm();
}

PoseSolution SolvePose(const RectifiedCamera& camera, Span<const PointSighting> sightings,
                       const SE3& T_world_camera) {
  PoseSolution solution;
  solution.T_world_camera = T_world_camera;
  solution.inliers.assign(sightings.size(), 1);
  solution.inlier_count = sightings.size();
  for (int round = 0; round < kRounds && solution.inlier_count >= kLeastSightings; ++round) {
    solution.T_world_camera = Descend(camera, sightings, solution.inliers, solution.T_world_camera,
                                      round < kRobustRounds);
    const SE3 T_camera_world = solution.T_world_camera.Inverse();
    solution.inlier_count = 0;
    for (size_t i = 0; i < sightings.size(); ++i) {
      const bool fits = SquaredError(camera, T_camera_world, sightings[i]) <=
                        OutlierThreshold(sightings[i].has_right);
      solution.inliers[i] = fits ? 1 : 0;
      solution.inlier_count += fits ? 1 : 0;
    }
  }
  return solution;
}

}  // namespace regolith
