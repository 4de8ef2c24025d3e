// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>

#include "regolith/factors/pose_manifold.h"
#include "regolith/geometry/so3.h"

namespace regolith {

/// A measured motion between two poses (PoseManifold blocks T_world_i and T_world_j). Six residuals
/// in standard deviations: square root of the information times
///   [Log(R_ijᵀ R_iᵀ R_j), R_iᵀ (p_j - p_i) - p_ij]   [rad, m; frame i].
class RelativePoseFactor final
    : public ceres::SizedCostFunction<6, kPoseBlockSize, kPoseBlockSize> {
 public:
  /// `square_root_information`: W with Wᵀ W the inverse covariance of the measurement's error,
  /// [rotation (right, rad), position (m)] as in Plus(T_i_j, ·).
  RelativePoseFactor(const SE3& T_i_j, const Matrix6d& square_root_information)
      : T_i_j_(T_i_j), square_root_information_(square_root_information) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const SE3 T_world_i = FromPoseBlock(blocks[0]);
    const SE3 T_world_j = FromPoseBlock(blocks[1]);
    const Eigen::Matrix3d R_i_world = T_world_i.rotation.conjugate().toRotationMatrix();
    const Eigen::Vector3d p_i_j = R_i_world * (T_world_j.translation - T_world_i.translation);
    Vector6d error;
    error << LogSo3(T_i_j_.rotation.conjugate() * T_world_i.rotation.conjugate() *
                    T_world_j.rotation),
        p_i_j - T_i_j_.translation;
    Eigen::Map<Vector6d>(residuals, 6) = square_root_information_ * error;
    if (jacobians == nullptr) return true;

    // Log(E Exp(φ_j)) ≈ Log(E) + J_r⁻¹ φ_j; Exp(-φ_i) is moved to the right past R_iᵀ R_j.
    const Eigen::Matrix3d inverse_jacobian = RightJacobianInverseSo3(error.head<3>());
    if (jacobians[0] != nullptr) {
      Matrix6d jacobian = Matrix6d::Zero();
      const Eigen::Matrix3d R_j_i =
          (T_world_j.rotation.conjugate() * T_world_i.rotation).toRotationMatrix();
      jacobian.topLeftCorner<3, 3>() = -inverse_jacobian * R_j_i;
      jacobian.bottomLeftCorner<3, 3>() = Hat(p_i_j);
      jacobian.bottomRightCorner<3, 3>() = -R_i_world;
      Write(jacobian, blocks[0], jacobians[0]);
    }
    if (jacobians[1] != nullptr) {
      Matrix6d jacobian = Matrix6d::Zero();
      jacobian.topLeftCorner<3, 3>() = inverse_jacobian;
      jacobian.bottomRightCorner<3, 3>() = R_i_world;
      Write(jacobian, blocks[1], jacobians[1]);
    }
    return true;
  }

 private:
  void Write(const Matrix6d& tangent_jacobian, const double* block, double* jacobian) const {
    WritePoseJacobian<6>(square_root_information_ * tangent_jacobian, block, jacobian);
  }

  SE3 T_i_j_;
  Matrix6d square_root_information_;
};

}  // namespace regolith
