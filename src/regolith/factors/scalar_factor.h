// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>

namespace regolith {

/// One value that was measured, such as an inverse distance by a lidar: (x - value) / sigma.
class ScalarFactor final : public ceres::SizedCostFunction<1, 1> {
 public:
  ScalarFactor(double value, double sigma) : value_(value), sigma_(sigma) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    residuals[0] = (blocks[0][0] - value_) / sigma_;
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = 1.0 / sigma_;
    return true;
  }

 private:
  double value_;
  double sigma_;
};

/// One value that wanders: (x_j - x_i) / sigma.
class ScalarWalkFactor final : public ceres::SizedCostFunction<1, 1, 1> {
 public:
  explicit ScalarWalkFactor(double sigma) : sigma_(sigma) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    residuals[0] = (blocks[1][0] - blocks[0][0]) / sigma_;
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) jacobians[0][0] = -1.0 / sigma_;
    if (jacobians[1] != nullptr) jacobians[1][0] = 1.0 / sigma_;
    return true;
  }

 private:
  double sigma_;
};

}  // namespace regolith
