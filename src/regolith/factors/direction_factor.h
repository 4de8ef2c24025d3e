// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/factors/pose_manifold.h"
#include "regolith/geometry/so3.h"

namespace regolith {

/// A direction of the world seen from a body: `up` by its accelerometer, or that of the sun. Two
/// residuals in standard deviations, for a PoseManifold block T_world_body:
///   Bᵀ R_world_bodyᵀ direction_world / σ
/// where the columns of B are orthonormal and across the direction measured [rad].
class DirectionFactor final : public ceres::SizedCostFunction<2, kPoseBlockSize> {
 public:
  /// Unit vectors. `sigma`: rad, of the direction measured, about each axis across it.
  DirectionFactor(const Eigen::Vector3d& direction_world, const Eigen::Vector3d& direction_body,
                  double sigma)
      : direction_world_(direction_world) {
    across_.row(0) = direction_body.unitOrthogonal().transpose() / sigma;
    across_.row(1) = direction_body.cross(across_.row(0).transpose()).transpose();
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const SE3 T_world_body = FromPoseBlock(blocks[0]);
    const Eigen::Vector3d seen_body = T_world_body.rotation.conjugate() * direction_world_;
    Eigen::Map<Eigen::Vector2d>(residuals, 2) = across_ * seen_body;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    // Exp(-φ) d ≈ d + d × φ.
    Eigen::Matrix<double, 2, 6> tangent_jacobian = Eigen::Matrix<double, 2, 6>::Zero();
    tangent_jacobian.leftCols<3>() = across_ * Hat(seen_body);
    WritePoseJacobian<2>(tangent_jacobian, blocks[0], jacobians[0]);
    return true;
  }

 private:
  Eigen::Vector3d direction_world_;
  Eigen::Matrix<double, 2, 3> across_;
};

}  // namespace regolith
