// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/factors/relative_pose_factor.h"

#include <gtest/gtest.h>

#include <array>

namespace regolith {
namespace {

const SE3 kFirst(ExpSo3({0.3, -0.5, 1.2}), {2.0, -1.0, 0.3});
const SE3 kMeasured(ExpSo3({0.1, 0.05, -0.4}), {0.8, 0.1, -0.05});

Matrix6d SquareRootInformation() {
  // Full, so that a transposed or reordered block shows.
  Matrix6d root = Matrix6d::Identity();
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) root(i, j) += 0.3 * (i + 1) - 0.1 * j;
  }
  return root;
}

TEST(RelativePoseFactor, IsZeroAtTheMeasuredMotion) {
  const RelativePoseFactor factor(kMeasured, SquareRootInformation());
  const PoseBlock first = ToPoseBlock(kFirst);
  const PoseBlock second = ToPoseBlock(kFirst * kMeasured);
  const std::array<const double*, 2> blocks = {first.data(), second.data()};
  Vector6d residuals;
  ASSERT_TRUE(factor.Evaluate(blocks.data(), residuals.data(), nullptr));
  EXPECT_LT(residuals.norm(), 1e-12);
}

TEST(RelativePoseFactor, CountsItsErrorInStandardDeviations) {
  Matrix6d root = Matrix6d::Identity();
  root.diagonal() << 100.0, 100.0, 100.0, 10.0, 10.0, 10.0;
  const RelativePoseFactor factor(kMeasured, root);
  Vector6d error;
  error << 0.01, -0.02, 0.03, 0.1, 0.2, -0.3;
  const PoseBlock first = ToPoseBlock(kFirst);
  const PoseBlock second = ToPoseBlock(kFirst * Plus(kMeasured, error));
  const std::array<const double*, 2> blocks = {first.data(), second.data()};
  Vector6d residuals;
  factor.Evaluate(blocks.data(), residuals.data(), nullptr);
  EXPECT_LT((residuals - root * error).norm(), 1e-12);
}

// By hand: Eigen matrices on the heap cannot be shared with Debian's Ceres
// (ceres::GradientChecker), since our processor flags give them another alignment.
TEST(RelativePoseFactor, JacobiansAreThoseOfTheResiduals) {
  const RelativePoseFactor factor(kMeasured, SquareRootInformation());
  Vector6d error;
  error << 0.2, -0.3, 0.4, 0.5, -0.7, 0.2;
  const std::array<PoseBlock, 2> poses = {ToPoseBlock(kFirst),
                                          ToPoseBlock(kFirst * Plus(kMeasured, error))};
  const PoseManifold manifold;
  std::array<Eigen::Matrix<double, 6, kPoseBlockSize, Eigen::RowMajor>, 2> ambient;
  const std::array<const double*, 2> blocks = {poses[0].data(), poses[1].data()};
  std::array<double*, 2> jacobians = {ambient[0].data(), ambient[1].data()};
  Vector6d residuals;
  ASSERT_TRUE(factor.Evaluate(blocks.data(), residuals.data(), jacobians.data()));
  constexpr double kStep = 1e-5;
  for (size_t pose = 0; pose < 2; ++pose) {
    Eigen::Matrix<double, kPoseBlockSize, 6, Eigen::RowMajor> plus;
    ASSERT_TRUE(manifold.PlusJacobian(poses[pose].data(), plus.data()));
    const Matrix6d analytic = ambient[pose] * plus;
    Matrix6d numeric;
    for (int axis = 0; axis < 6; ++axis) {
      std::array<Vector6d, 2> ends;
      for (size_t side = 0; side < 2; ++side) {
        Vector6d tangent = Vector6d::Zero();
        tangent[axis] = side == 0 ? -kStep : kStep;
        PoseBlock moved;
        ASSERT_TRUE(manifold.Plus(poses[pose].data(), tangent.data(), moved.data()));
        std::array<const double*, 2> changed = blocks;
        changed[pose] = moved.data();
        ASSERT_TRUE(factor.Evaluate(changed.data(), ends[side].data(), nullptr));
      }
      numeric.col(axis) = (ends[1] - ends[0]) / (2.0 * kStep);
    }
    EXPECT_LT((analytic - numeric).cwiseAbs().maxCoeff(), 1e-7) << "pose " << pose;
  }
}

}  // namespace
}  // namespace regolith
