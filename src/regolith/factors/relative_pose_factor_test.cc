// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/factors/relative_pose_factor.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <ceres/gradient_checker.h>

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

TEST(RelativePoseFactor, JacobiansAreThoseOfTheResiduals) {
  const RelativePoseFactor factor(kMeasured, SquareRootInformation());
  Vector6d error;
  error << 0.2, -0.3, 0.4, 0.5, -0.7, 0.2;
  const PoseBlock first = ToPoseBlock(kFirst);
  const PoseBlock second = ToPoseBlock(kFirst * Plus(kMeasured, error));
  const std::array<const double*, 2> blocks = {first.data(), second.data()};
  const PoseManifold manifold;
  const std::vector<const ceres::Manifold*> manifolds = {&manifold, &manifold};
  ceres::GradientChecker checker(&factor, &manifolds, ceres::NumericDiffOptions());
  ceres::GradientChecker::ProbeResults results;
  // The checker's own verdict is relative, and fails on entries that are 0.
  checker.Probe(blocks.data(), 1e-6, &results);
  for (size_t i = 0; i < 2; ++i) {
    const auto& analytic = results.local_jacobians[i];
    const auto& numeric = results.local_numeric_jacobians[i];
    EXPECT_LT((analytic - numeric).cwiseAbs().maxCoeff(), 1e-8) << "pose " << i;
  }
}

}  // namespace
}  // namespace regolith
