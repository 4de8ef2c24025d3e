// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>

#include "regolith/factors/pose_manifold.h"
#include "regolith/geometry/so3.h"

namespace regolith {

/// A measured pose (PoseManifold block T_world_body). Six residuals in standard deviations: square
/// root of the information times Minus(T_world_body, measured) [rad, m; world frame].
class PosePriorFactor final : public ceres::SizedCostFunction<6, kPoseBlockSize> {
 public:
  /// `square_root_information`: W with Wᵀ W the inverse covariance, as Plus(measured, ·).
  PosePriorFactor(const SE3& T_world_body, const Matrix6d& square_root_information)
      : T_world_body_(T_world_body), square_root_information_(square_root_information) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const Vector6d error = Minus(FromPoseBlock(blocks[0]), T_world_body_);
    Eigen::Map<Vector6d>(residuals, 6) = square_root_information_ * error;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Matrix6d jacobian = Matrix6d::Identity();
    jacobian.topLeftCorner<3, 3>() = RightJacobianInverseSo3(error.head<3>());
    WritePoseJacobian<6>(square_root_information_ * jacobian, blocks[0], jacobians[0]);
    return true;
  }

 private:
  SE3 T_world_body_;
  Matrix6d square_root_information_;
};

}  // namespace regolith
