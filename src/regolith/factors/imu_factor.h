// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "regolith/core/check.h"
#include "regolith/factors/gravity_tilt.h"
#include "regolith/factors/motion_block.h"
#include "regolith/imu/preintegration.h"

namespace regolith {

/// What inertial measurements say between two states (Forster et al. 2017, eq. 45). Blocks: pose
/// and motion of the first state, pose and motion of the second, tilt of gravity. Fifteen residuals
/// in standard deviations: [rotation, position, velocity, gyro bias, accelerometer bias].
class ImuFactor final
    : public ceres::SizedCostFunction<15, kPoseBlockSize, kMotionBlockSize, kPoseBlockSize,
                                      kMotionBlockSize, kTiltBlockSize> {
 public:
  /// `gravity`: magnitude, m/s². Throws CheckError where the motion has no duration.
  ImuFactor(const ImuPreintegration& motion, double gravity) : motion_(motion), gravity_(gravity) {
    REGOLITH_CHECK(motion.duration() > 0.0, "duration ", motion.duration());
    const Matrix15d information = motion.FullCovariance().inverse();
    square_root_information_ =
        Eigen::LLT<Matrix15d>(0.5 * (information + information.transpose())).matrixU();
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const NavState from = FromBlocks(blocks[0], blocks[1]);
    const NavState to = FromBlocks(blocks[2], blocks[3]);
    const Eigen::Vector2d tilt = Eigen::Map<const Eigen::Vector2d>(blocks[4]);
    const ImuResidual residual = motion_.Residual(from, to, GravityFromTilt(tilt, gravity_));
    Eigen::Map<Vector15d>(residuals, 15) = square_root_information_ * residual.value;
    if (jacobians == nullptr) return true;
    const Matrix15d by_from = square_root_information_ * residual.jacobian_from;
    const Matrix15d by_to = square_root_information_ * residual.jacobian_to;
    WritePoseJacobian<15>(by_from.leftCols<6>(), blocks[0], jacobians[0]);
    WriteMotion(by_from, jacobians[1]);
    WritePoseJacobian<15>(by_to.leftCols<6>(), blocks[2], jacobians[2]);
    WriteMotion(by_to, jacobians[3]);
    WriteTilt(from, tilt, jacobians[4]);
    return true;
  }

 private:
  static void WriteMotion(const Matrix15d& by_state, double* jacobian) {
    if (jacobian == nullptr) return;
    Eigen::Map<Eigen::Matrix<double, 15, kMotionBlockSize, Eigen::RowMajor>> written(jacobian);
    written = by_state.rightCols<9>();
  }

  void WriteTilt(const NavState& from, const Eigen::Vector2d& tilt, double* jacobian) const {
    if (jacobian == nullptr) return;
    const double time = motion_.duration();
    const Eigen::Matrix<double, 3, 2> gravity_imu =
        from.T_world_imu.rotation.conjugate().toRotationMatrix() *
        GravityTiltJacobian(tilt, gravity_);
    Eigen::Matrix<double, 15, 2> by_tilt = Eigen::Matrix<double, 15, 2>::Zero();
    by_tilt.middleRows<3>(3) = -0.5 * time * time * gravity_imu;
    by_tilt.middleRows<3>(6) = -time * gravity_imu;
    Eigen::Map<Eigen::Matrix<double, 15, kTiltBlockSize, Eigen::RowMajor>> written(jacobian);
    written = square_root_information_ * by_tilt;
  }

  ImuPreintegration motion_;
  double gravity_;
  Matrix15d square_root_information_;
};

}  // namespace regolith
