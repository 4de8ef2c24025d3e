// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include <vector>

#include <Eigen/Core>

#include "regolith/factors/pose_manifold.h"

namespace regolith {

/// A value moved by a tangent vector: poses as PoseManifold does, all others by addition.
inline Eigen::VectorXd Moved(const Eigen::VectorXd& value, const Eigen::VectorXd& tangent) {
  if (value.size() != kPoseBlockSize) return value + tangent;
  return ToPoseBlock(Plus(FromPoseBlock(value.data()), Vector6d(tangent)));
}

inline Eigen::VectorXd ResidualsOf(const ceres::CostFunction& factor,
                                   const std::vector<Eigen::VectorXd>& values) {
  std::vector<const double*> pointers;
  for (const Eigen::VectorXd& value : values) pointers.push_back(value.data());
  Eigen::VectorXd residuals(factor.num_residuals());
  EXPECT_TRUE(factor.Evaluate(pointers.data(), residuals.data(), nullptr));
  return residuals;
}

/// Compares a factor's Jacobians with differences of its residuals, in tangent spaces. By hand,
/// since Eigen matrices on the heap cannot be shared with Debian's Ceres (ceres::GradientChecker):
/// our processor flags give them another alignment.
inline void ExpectJacobiansMatch(const ceres::CostFunction& factor,
                                 const std::vector<Eigen::VectorXd>& values, double tolerance) {
  using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<const double*> pointers;
  std::vector<RowMajorMatrix> ambient;
  for (size_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(factor.parameter_block_sizes()[i], values[i].size());
    pointers.push_back(values[i].data());
    ambient.emplace_back(factor.num_residuals(), values[i].size());
  }
  std::vector<double*> jacobians;
  for (RowMajorMatrix& jacobian : ambient) jacobians.push_back(jacobian.data());
  Eigen::VectorXd residuals(factor.num_residuals());
  ASSERT_TRUE(factor.Evaluate(pointers.data(), residuals.data(), jacobians.data()));
  EXPECT_LT((residuals - ResidualsOf(factor, values)).norm(), 1e-12);
  constexpr double kStep = 1e-6;
  for (size_t i = 0; i < values.size(); ++i) {
    Eigen::MatrixXd analytic = ambient[i];
    if (values[i].size() == kPoseBlockSize) {
      Eigen::Matrix<double, kPoseBlockSize, 6, Eigen::RowMajor> plus;
      ASSERT_TRUE(PoseManifold().PlusJacobian(values[i].data(), plus.data()));
      analytic = ambient[i] * plus;
    }
    for (Eigen::Index axis = 0; axis < analytic.cols(); ++axis) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(analytic.cols(), axis);
      std::vector<Eigen::VectorXd> forward = values;
      std::vector<Eigen::VectorXd> backward = values;
      forward[i] = Moved(values[i], step);
      backward[i] = Moved(values[i], -step);
      const Eigen::VectorXd numeric =
          (ResidualsOf(factor, forward) - ResidualsOf(factor, backward)) / (2.0 * kStep);
      EXPECT_LT((analytic.col(axis) - numeric).cwiseAbs().maxCoeff(),
                tolerance * std::max(1.0, numeric.cwiseAbs().maxCoeff()))
          << "block " << i << ", axis " << axis;
    }
  }
}

}  // namespace regolith
