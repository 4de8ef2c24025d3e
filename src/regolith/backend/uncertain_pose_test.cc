// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/uncertain_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

const SE3 kFirst(ExpSo3({0.2, -0.3, 1.1}), {3.0, -1.0, 0.4});
const SE3 kSecond(ExpSo3({-0.1, 0.2, -2.0}), {0.5, 2.0, -0.2});

Matrix6d SomeCovariance(double scale) {
  Matrix6d root = scale * Matrix6d::Identity();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) root(i, j) = scale * 0.2 * (i - 2 * j);
  }
  return root * root.transpose();
}

Vector6d Draw(const Matrix6d& covariance, Random* random) {
  Vector6d normal;
  for (int i = 0; i < 6; ++i) normal[i] = random->Gaussian();
  return covariance.llt().matrixL() * normal;
}

// The covariances of composition and inverse are those of many draws.
TEST(UncertainPose, CovariancesMoveWithThePoses) {
  const UncertainPose first{kFirst, SomeCovariance(2e-3)};
  const UncertainPose second{kSecond, SomeCovariance(3e-3)};
  const UncertainPose both = Compose(first, Inverse(second));
  Random random(3);
  Matrix6d sum = Matrix6d::Zero();
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    const SE3 a = kFirst * ExpSe3(Draw(first.covariance, &random));
    const SE3 b = kSecond * ExpSe3(Draw(second.covariance, &random));
    const Vector6d error = LogSe3(both.T_a_b.Inverse() * (a * b.Inverse()));
    sum += error * error.transpose();
  }
  EXPECT_LT((sum / kDraws - both.covariance).norm(), 0.03 * both.covariance.norm());
}

TEST(UncertainPose, PlusAndExpCovariancesAreOneAndTheSame) {
  const Matrix6d plus = SomeCovariance(1e-4);
  Random random(5);
  Matrix6d sum = Matrix6d::Zero();
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    const Vector6d error = LogSe3(kFirst.Inverse() * Plus(kFirst, Draw(plus, &random)));
    sum += error * error.transpose();
  }
  const Matrix6d exp = PlusToExpCovariance(plus, kFirst);
  EXPECT_LT((sum / kDraws - exp).norm(), 0.03 * exp.norm());
  EXPECT_LT((ExpToPlusCovariance(exp, kFirst) - plus).norm(), 1e-12);
}

TEST(UncertainPose, WhatNothingIsKnownOfStaysUnknown) {
  Matrix6d information = Matrix6d::Zero();
  information.diagonal() << 100.0, 100.0, 100.0, 0.0, 400.0, 400.0;
  const Matrix6d covariance = CovarianceOf(information);
  EXPECT_NEAR(covariance(3, 3), kUnknownVariance, 1e-6);
  EXPECT_NEAR(covariance(4, 4), 1.0 / 400.0, 1e-12);
  EXPECT_LT((InformationOf(covariance) - information).norm(), 1e-9);
  const Matrix6d root = SquareRootOf(information);
  EXPECT_LT((root.transpose() * root - information).norm(), 1e-9);
  // What the one does not know the other says.
  Matrix6d other = Matrix6d::Zero();
  other(3, 3) = 25.0;
  SE3 shifted = kFirst;
  shifted = shifted * SE3(Eigen::Quaterniond::Identity(), {0.3, 7.0, 7.0});
  const UncertainPose fused = Fuse({kFirst, covariance}, {shifted, CovarianceOf(other)});
  const SE3 change = kFirst.Inverse() * fused.T_a_b;
  EXPECT_LT((change.translation - Eigen::Vector3d(0.3, 0.0, 0.0)).norm(), 1e-6);
}

TEST(UncertainPose, DistanceCountsBothErrors) {
  Matrix6d covariance = Matrix6d::Identity() * 0.02;
  const SE3 moved = kFirst * SE3(Eigen::Quaterniond::Identity(), {0.6, 0.0, 0.0});
  EXPECT_NEAR(SquaredDistance({kFirst, covariance}, {moved, covariance}), 9.0, 1e-9);
}

}  // namespace
}  // namespace regolith
