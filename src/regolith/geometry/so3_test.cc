// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/geometry/so3.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

Eigen::Vector3d RandomVector(Random& random, double length) {
  Eigen::Vector3d vector(random.Gaussian(), random.Gaussian(), random.Gaussian());
  return length * vector.normalized();
}

TEST(So3, LogInvertsExpFromZeroToNearPi) {
  Random random(1);
  for (const double angle : {0.0, 1e-9, 1e-5, 9.9e-5, 1.1e-4, 0.3, 2.0, 3.14}) {
    const Eigen::Vector3d vector = RandomVector(random, angle);
    EXPECT_LT((LogSo3(ExpSo3(vector)) - vector).norm(), 1e-9) << angle;
  }
}

TEST(So3, ExpMatchesAngleAxis) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(0.7, axis));
  EXPECT_LT(AngleBetween(ExpSo3(0.7 * axis), expected), 1e-12);
}

TEST(So3, RightJacobianMatchesNumericDifferences) {
  Random random(2);
  for (const double angle : {1e-6, 1e-3, 0.5, 2.5}) {
    const Eigen::Vector3d vector = RandomVector(random, angle);
    const Eigen::Matrix3d jacobian = RightJacobianSo3(vector);
    for (int i = 0; i < 3; ++i) {
      const double step = 1e-6;
      const Eigen::Vector3d delta = step * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d numeric =
          (LogSo3(ExpSo3(vector).conjugate() * ExpSo3(vector + delta)) -
           LogSo3(ExpSo3(vector).conjugate() * ExpSo3(vector - delta))) /
          (2.0 * step);
      EXPECT_LT((numeric - jacobian.col(i)).norm(), 1e-7) << angle << " " << i;
    }
    EXPECT_LT((jacobian * RightJacobianInverseSo3(vector) - Eigen::Matrix3d::Identity()).norm(),
              1e-9);
  }
}

TEST(So3, RotationBetweenTurnsOneVectorOntoTheOther) {
  const Eigen::Vector3d from = Eigen::Vector3d(0.3, -1.0, 2.0).normalized();
  for (const Eigen::Vector3d& to : {Eigen::Vector3d(0.0, 0.0, 1.0), Eigen::Vector3d(-from)}) {
    EXPECT_LT((RotationBetween(from, to) * from - to).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace regolith
