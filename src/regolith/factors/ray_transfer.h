// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "regolith/factors/pose_manifold.h"
#include "regolith/geometry/so3.h"

namespace regolith {

/// A feature as one camera saw it at one time.
struct FeatureSighting {
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  ///< unit, camera frame
  /// 1/s, how the bearing changed; what a time offset moves it by.
  Eigen::Vector3d bearing_rate = Eigen::Vector3d::Zero();
  double time_offset = 0.0;  ///< s, that its frame's time was made with
};

/// Two columns that span the plane across a unit bearing.
inline Eigen::Matrix<double, 3, 2> TangentPlane(const Eigen::Vector3d& bearing) {
  const Eigen::Vector3d axis =
      std::abs(bearing.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = bearing.cross(axis).normalized();
  plane.col(1) = bearing.cross(plane.col(0));
  return plane;
}

/// The ray (any length, target camera) to a landmark that a source camera sees along a bearing b at
/// inverse distance ρ (1/m; also 0, at infinity), from the body's pose i to its pose j:
///   z = R_jᵀ (R_i (R_s b + ρ p_s) + ρ (p_i - p_j)),  y = R_tᵀ (z - ρ p_t),
/// where [R_s, p_s], [R_t, p_t] are the cameras in the body.
struct RayTransfer {
  Eigen::Vector3d ray_target = Eigen::Vector3d::UnitZ();  ///< y
  Eigen::Matrix<double, 3, 6> by_pose_i;
  Eigen::Matrix<double, 3, 6> by_pose_j;
  Eigen::Matrix<double, 3, 6> by_source;  ///< pose of the source camera in the body
  Eigen::Matrix<double, 3, 6> by_target;  ///< pose of the target camera in the body
  Eigen::Vector3d by_inverse_distance;
  Eigen::Matrix3d by_bearing;

  RayTransfer(const SE3& T_world_i, const SE3& T_world_j, const SE3& T_body_source,
              const SE3& T_body_target, const Eigen::Vector3d& bearing, double inverse_distance,
              bool with_jacobians) {
    const Eigen::Matrix3d R_i = T_world_i.rotation.toRotationMatrix();
    const Eigen::Matrix3d R_j_world = T_world_j.rotation.conjugate().toRotationMatrix();
    const Eigen::Matrix3d R_source = T_body_source.rotation.toRotationMatrix();
    const Eigen::Matrix3d R_target_body = T_body_target.rotation.conjugate().toRotationMatrix();
    const Eigen::Vector3d step = T_world_i.translation - T_world_j.translation;
    const Eigen::Vector3d ray_i = R_source * bearing + inverse_distance * T_body_source.translation;
    const Eigen::Vector3d ray_j = R_j_world * (R_i * ray_i + inverse_distance * step);
    ray_target = R_target_body * (ray_j - inverse_distance * T_body_target.translation);
    if (!with_jacobians) return;

    const Eigen::Matrix3d R_target_world = R_target_body * R_j_world;
    const Eigen::Matrix3d R_target_i = R_target_world * R_i;
    by_pose_i << -R_target_i * Hat(ray_i), inverse_distance * R_target_world;
    by_pose_j << R_target_body * Hat(ray_j), -inverse_distance * R_target_world;
    by_bearing = R_target_i * R_source;
    by_source << -by_bearing * Hat(bearing), inverse_distance * R_target_i;
    by_target << Hat(ray_target), -inverse_distance * R_target_body;
    by_inverse_distance = R_target_world * (R_i * T_body_source.translation + step) -
                          R_target_body * T_body_target.translation;
  }
};

/// The difference between a ray and a bearing on the plane across the bearing, in standard
/// deviations.
struct BearingError {
  Eigen::Vector2d value;
  Eigen::Matrix<double, 2, 3> by_ray;
  Eigen::Matrix<double, 2, 3> by_bearing;

  /// `plane`: TangentPlane of about the bearing. `sigma`: rad.
  BearingError(const Eigen::Vector3d& ray, const Eigen::Vector3d& bearing,
               const Eigen::Matrix<double, 3, 2>& plane, double sigma) {
    const double length = ray.norm();
    const Eigen::Vector3d direction = ray / length;
    value = plane.transpose() * (direction - bearing) / sigma;
    by_bearing = -plane.transpose() / sigma;
    by_ray = plane.transpose() * (Eigen::Matrix3d::Identity() - direction * direction.transpose()) /
             (length * sigma);
  }
};

}  // namespace regolith
