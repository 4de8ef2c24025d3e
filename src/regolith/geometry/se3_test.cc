// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/geometry/se3.h"

#include <gtest/gtest.h>

#include "regolith/core/random.h"

namespace regolith {
namespace {

Vector6d RandomTangent(Random& random, double rotation_scale) {
  Vector6d tangent;
  for (int i = 0; i < 6; ++i) tangent[i] = random.Gaussian(0.0, i < 3 ? rotation_scale : 1.0);
  return tangent;
}

TEST(Se3, ComposesAndInvertsLikeItsMatrix) {
  Random random(1);
  const SE3 first = ExpSe3(RandomTangent(random, 1.0));
  const SE3 second = ExpSe3(RandomTangent(random, 1.0));
  EXPECT_LT(((first * second).Matrix() - first.Matrix() * second.Matrix()).norm(), 1e-12);
  EXPECT_LT(((first * first.Inverse()).Matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
  EXPECT_LT((SE3::FromMatrix(first.Matrix()).Matrix() - first.Matrix()).norm(), 1e-12);
}

TEST(Se3, LogInvertsExp) {
  Random random(2);
  for (const double scale : {0.0, 1e-7, 1e-3, 0.02, 0.8}) {
    const Vector6d tangent = RandomTangent(random, scale);
    EXPECT_LT((LogSe3(ExpSe3(tangent)) - tangent).norm(), 1e-9) << scale;
  }
}

TEST(Se3, AdjointMovesAPerturbationToTheOtherSide) {
  Random random(3);
  const SE3 transform = ExpSe3(RandomTangent(random, 1.0));
  const Vector6d tangent = 0.1 * RandomTangent(random, 1.0);
  const SE3 left = transform * ExpSe3(tangent) * transform.Inverse();
  const SE3 right = ExpSe3(AdjointSe3(transform) * tangent);
  EXPECT_LT((left.Matrix() - right.Matrix()).norm(), 1e-9);
}

TEST(Se3, RightJacobianMatchesNumericDifferences) {
  Random random(4);
  for (const double scale : {1e-6, 5e-3, 0.05, 0.7}) {
    const Vector6d tangent = RandomTangent(random, scale);
    const Matrix6d jacobian = RightJacobianSe3(tangent);
    for (int i = 0; i < 6; ++i) {
      const double step = 1e-6;
      const Vector6d delta = step * Vector6d::Unit(i);
      const SE3 inverse = ExpSe3(tangent).Inverse();
      const Vector6d numeric =
          (LogSe3(inverse * ExpSe3(tangent + delta)) - LogSe3(inverse * ExpSe3(tangent - delta))) /
          (2.0 * step);
      EXPECT_LT((numeric - jacobian.col(i)).norm(), 1e-6) << scale << " column " << i;
    }
    EXPECT_LT((jacobian * RightJacobianInverseSe3(tangent) - Matrix6d::Identity()).norm(), 1e-9);
  }
}

TEST(Se3, MinusInvertsPlus) {
  Random random(5);
  const SE3 transform = ExpSe3(RandomTangent(random, 1.0));
  const Vector6d tangent = RandomTangent(random, 0.5);
  EXPECT_LT((Minus(Plus(transform, tangent), transform) - tangent).norm(), 1e-10);
}

TEST(Se3, InterpolatesHalfTheAngleAndHalfTheWay) {
  const SE3 from;
  const SE3 to(Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ())),
               Eigen::Vector3d(2.0, 4.0, 6.0));
  const SE3 middle = Interpolate(from, to, 0.5);
  EXPECT_NEAR(Eigen::AngleAxisd(middle.rotation).angle(), 0.5, 1e-12);
  EXPECT_LT((middle.translation - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 1e-12);
}

}  // namespace
}  // namespace regolith
