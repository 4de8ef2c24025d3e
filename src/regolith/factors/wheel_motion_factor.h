// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>

#include "regolith/factors/pose_manifold.h"
#include "regolith/geometry/so3.h"

namespace regolith {

/// How far the wheels went between two poses, with slip: they say more than the way that was gone.
/// Blocks: pose i, pose j (T_world_imu), slip (one value). Three residuals in standard deviations:
///   W (R_world_baseᵀ (p_base_j - p_base_i) - (1 - slip) d),
/// where d (m, first base frame) is the wheels' way turned by the gyro.
class WheelMotionFactor final
    : public ceres::SizedCostFunction<3, kPoseBlockSize, kPoseBlockSize, 1> {
 public:
  WheelMotionFactor(const SE3& T_imu_base, const Eigen::Vector3d& way_base,
                    const Eigen::Matrix3d& square_root_information)
      : T_imu_base_(T_imu_base),
        way_base_(way_base),
        square_root_information_(square_root_information) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const SE3 T_world_i = FromPoseBlock(blocks[0]);
    const SE3 T_world_j = FromPoseBlock(blocks[1]);
    const double slip = blocks[2][0];
    const Eigen::Matrix3d R_i_world = T_world_i.rotation.conjugate().toRotationMatrix();
    const Eigen::Matrix3d R_base_imu = T_imu_base_.rotation.conjugate().toRotationMatrix();
    const Eigen::Vector3d& lever = T_imu_base_.translation;
    const Eigen::Vector3d to_j =
        R_i_world * (T_world_j.translation + T_world_j.rotation * lever - T_world_i.translation);
    Eigen::Map<Eigen::Vector3d>(residuals, 3) =
        square_root_information_ * (R_base_imu * (to_j - lever) - (1.0 - slip) * way_base_);
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr)
      Write(R_base_imu * Hat(to_j), -R_base_imu * R_i_world, blocks[0], jacobians[0]);
    if (jacobians[1] != nullptr) {
      const Eigen::Matrix3d R_i_j = R_i_world * T_world_j.rotation.toRotationMatrix();
      Write(-R_base_imu * R_i_j * Hat(lever), R_base_imu * R_i_world, blocks[1], jacobians[1]);
    }
    if (jacobians[2] != nullptr) {
      Eigen::Map<Eigen::Vector3d>(jacobians[2], 3) = square_root_information_ * way_base_;
    }
    return true;
  }

 private:
  void Write(const Eigen::Matrix3d& by_rotation, const Eigen::Matrix3d& by_position,
             const double* block, double* jacobian) const {
    Eigen::Matrix<double, 3, 6> by_pose;
    by_pose << by_rotation, by_position;
    WritePoseJacobian<3>(square_root_information_ * by_pose, block, jacobian);
  }

  SE3 T_imu_base_;
  Eigen::Vector3d way_base_;
  Eigen::Matrix3d square_root_information_;
};

}  // namespace regolith
