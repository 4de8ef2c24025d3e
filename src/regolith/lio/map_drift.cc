// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/map_drift.h"

#include <Eigen/Geometry>

#include "regolith/geometry/so3.h"

namespace regolith {

void MapDrift::Advance(const SE3& T_map_from, const SE3& T_map_to,
                       const Matrix6d& match_covariance) {
  const SE3 step = T_map_from.Inverse() * T_map_to;
  // An error of the heading moves everything that comes after it.
  Matrix6d transition = Matrix6d::Identity();
  transition.topLeftCorner<3, 3>() = step.rotation.conjugate().toRotationMatrix();
  transition.bottomLeftCorner<3, 3>() =
      -T_map_from.rotation.toRotationMatrix() * Hat(step.translation);
  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  Vector6d shares;
  shares << Eigen::Vector3d::Constant(1.0 / options_.rotation_length),
      Eigen::Vector3d::Constant(1.0 / options_.position_length);
  const Vector6d roots = (step.translation.norm() * shares).cwiseSqrt();
  covariance_ += roots.asDiagonal() * match_covariance * roots.asDiagonal();
}

}  // namespace regolith
