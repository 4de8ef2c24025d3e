// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/plane_fit.h"

#include <gtest/gtest.h>

#include <vector>

#include <Eigen/Geometry>

#include "regolith/core/random.h"

namespace regolith {
namespace {

TEST(PlaneFit, FindsTheNormalAndTheSpread) {
  Random random(3);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.2, -0.3, 1.0).normalized();
  const Eigen::Vector3d along = normal.unitOrthogonal();
  const Eigen::Vector3d across = normal.cross(along);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 5000; ++i) {
    points.push_back(Eigen::Vector3d(5, 6, 7) + random.Gaussian(0, 1.0) * along +
                     random.Gaussian(0, 0.5) * across + random.Gaussian(0, 0.02) * normal);
  }
  const PlaneFit fit = FitPlane(points);
  EXPECT_GT(std::abs(fit.normal.dot(normal)), 0.9999);
  EXPECT_NEAR(std::sqrt(fit.variances[0]), 0.02, 0.002);
  EXPECT_NEAR(std::sqrt(fit.variances[1]), 0.5, 0.03);
  EXPECT_NEAR(std::sqrt(fit.variances[2]), 1.0, 0.05);
}

}  // namespace
}  // namespace regolith
