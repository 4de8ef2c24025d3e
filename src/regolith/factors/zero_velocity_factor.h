// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>

#include "regolith/factors/motion_block.h"

namespace regolith {

/// A state that stands still: its velocity (m/s) over `sigma`. Block: motion.
class ZeroVelocityFactor final : public ceres::SizedCostFunction<3, kMotionBlockSize> {
 public:
  explicit ZeroVelocityFactor(double sigma) : sigma_(sigma) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::Vector3d>(residuals, 3) =
        Eigen::Map<const Eigen::Vector3d>(blocks[0]) / sigma_;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, 3, kMotionBlockSize, Eigen::RowMajor>> written(jacobians[0]);
    written.setZero();
    written.leftCols<3>().diagonal().setConstant(1.0 / sigma_);
    return true;
  }

 private:
  double sigma_;
};

}  // namespace regolith
