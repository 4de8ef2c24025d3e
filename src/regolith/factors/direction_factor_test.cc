// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/factors/direction_factor.h"

#include <gtest/gtest.h>

#include <array>

namespace regolith {
namespace {

const SE3 kPose(ExpSo3({0.3, -0.2, 1.4}), {1.0, 2.0, 3.0});

Eigen::Vector2d Residual(const DirectionFactor& factor, const SE3& pose) {
  const PoseBlock block = ToPoseBlock(pose);
  const std::array<const double*, 1> blocks = {block.data()};
  Eigen::Vector2d residual;
  EXPECT_TRUE(factor.Evaluate(blocks.data(), residual.data(), nullptr));
  return residual;
}

TEST(DirectionFactor, CountsTheAngleInStandardDeviations) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d up_body = kPose.rotation.conjugate() * up;
  const DirectionFactor factor(up, up_body, 0.01);
  EXPECT_LT(Residual(factor, kPose).norm(), 1e-12);
  // A turn about the direction itself is not seen.
  SE3 turned = kPose;
  turned.rotation = ExpSo3({0.0, 0.0, 0.7}) * kPose.rotation;
  EXPECT_LT(Residual(factor, turned).norm(), 1e-12);
  turned.rotation = ExpSo3({0.0, 0.02, 0.0}) * kPose.rotation;
  EXPECT_NEAR(Residual(factor, turned).norm(), 2.0, 1e-3);
}

TEST(DirectionFactor, JacobianIsThatOfTheResidual) {
  const Eigen::Vector3d measured = Eigen::Vector3d(0.2, -0.4, 0.9).normalized();
  const DirectionFactor factor(Eigen::Vector3d(0.1, 0.2, 1.0).normalized(), measured, 0.02);
  const PoseBlock block = ToPoseBlock(kPose);
  const std::array<const double*, 1> blocks = {block.data()};
  Eigen::Vector2d residual;
  Eigen::Matrix<double, 2, kPoseBlockSize, Eigen::RowMajor> ambient;
  std::array<double*, 1> jacobians = {ambient.data()};
  ASSERT_TRUE(factor.Evaluate(blocks.data(), residual.data(), jacobians.data()));
  Eigen::Matrix<double, kPoseBlockSize, 6, Eigen::RowMajor> plus;
  ASSERT_TRUE(PoseManifold().PlusJacobian(block.data(), plus.data()));
  const Eigen::Matrix<double, 2, 6> analytic = ambient * plus;
  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 6; ++axis) {
    Vector6d tangent = Vector6d::Zero();
    tangent[axis] = kStep;
    const Eigen::Vector2d numeric =
        (Residual(factor, Plus(kPose, tangent)) - Residual(factor, Plus(kPose, -tangent))) /
        (2.0 * kStep);
    EXPECT_LT((analytic.col(axis) - numeric).norm(), 1e-6) << "axis " << axis;
  }
}

}  // namespace
}  // namespace regolith
