// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>

#include "regolith/factors/ray_transfer.h"

namespace regolith {

/// A landmark that the left camera sees and the right one sees at the same time: the disparity is
/// its distance. Blocks: T_imu_left, T_imu_right, inverse distance along the left bearing (1/m).
/// Two residuals in standard deviations, on the unit sphere of the right camera.
class StereoFactor final : public ceres::SizedCostFunction<2, kPoseBlockSize, kPoseBlockSize, 1> {
 public:
  /// Unit bearings, each in its camera's frame; `sigma` in rad.
  StereoFactor(const Eigen::Vector3d& bearing_left, const Eigen::Vector3d& bearing_right,
               double sigma)
      : left_(bearing_left),
        right_(bearing_right),
        sigma_(sigma),
        plane_(TangentPlane(bearing_right)) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const RayTransfer transfer(SE3(), SE3(), FromPoseBlock(blocks[0]), FromPoseBlock(blocks[1]),
                               left_, blocks[2][0], jacobians != nullptr);
    const BearingError error(transfer.ray_target, right_, plane_, sigma_);
    Eigen::Map<Eigen::Vector2d>(residuals, 2) = error.value;
    if (jacobians == nullptr) return true;
    WritePoseJacobian<2>(error.by_ray * transfer.by_source, blocks[0], jacobians[0]);
    WritePoseJacobian<2>(error.by_ray * transfer.by_target, blocks[1], jacobians[1]);
    if (jacobians[2] != nullptr) {
      Eigen::Map<Eigen::Vector2d>(jacobians[2], 2) = error.by_ray * transfer.by_inverse_distance;
    }
    return true;
  }

 private:
  Eigen::Vector3d left_;
  Eigen::Vector3d right_;
  double sigma_;
  Eigen::Matrix<double, 3, 2> plane_;
};

}  // namespace regolith
