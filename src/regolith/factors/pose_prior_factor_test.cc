// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/factors/pose_prior_factor.h"

#include <gtest/gtest.h>

#include <array>

namespace regolith {
namespace {

const SE3 kMeasured(ExpSo3({0.3, -0.2, 1.4}), {1.0, 2.0, 3.0});

Vector6d Residual(const PosePriorFactor& factor, const SE3& pose) {
  const PoseBlock block = ToPoseBlock(pose);
  const std::array<const double*, 1> blocks = {block.data()};
  Vector6d residual;
  EXPECT_TRUE(factor.Evaluate(blocks.data(), residual.data(), nullptr));
  return residual;
}

TEST(PosePriorFactor, JacobianIsThatOfTheResidual) {
  Matrix6d root = Matrix6d::Identity();
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) root(i, j) += 0.3 * (i + 1) - 0.1 * j;
  }
  const PosePriorFactor factor(kMeasured, root);
  EXPECT_LT(Residual(factor, kMeasured).norm(), 1e-12);
  Vector6d error;
  error << 0.2, -0.3, 0.4, 0.5, -0.7, 0.2;
  const SE3 pose = Plus(kMeasured, error);
  EXPECT_LT((Residual(factor, pose) - root * error).norm(), 1e-12);

  const PoseBlock block = ToPoseBlock(pose);
  const std::array<const double*, 1> blocks = {block.data()};
  Vector6d residual;
  Eigen::Matrix<double, 6, kPoseBlockSize, Eigen::RowMajor> ambient;
  std::array<double*, 1> jacobians = {ambient.data()};
  ASSERT_TRUE(factor.Evaluate(blocks.data(), residual.data(), jacobians.data()));
  Eigen::Matrix<double, kPoseBlockSize, 6, Eigen::RowMajor> plus;
  ASSERT_TRUE(PoseManifold().PlusJacobian(block.data(), plus.data()));
  const Matrix6d analytic = ambient * plus;
  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 6; ++axis) {
    Vector6d tangent = Vector6d::Zero();
    tangent[axis] = kStep;
    const Vector6d numeric =
        (Residual(factor, Plus(pose, tangent)) - Residual(factor, Plus(pose, -tangent))) /
        (2.0 * kStep);
    EXPECT_LT((analytic.col(axis) - numeric).norm(), 1e-6) << "axis " << axis;
  }
}

}  // namespace
}  // namespace regolith
