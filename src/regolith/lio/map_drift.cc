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
  covariance_ += (step.translation.norm() / renewal_length_) * match_covariance;
}

}  // namespace regolith
