// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/uniform_spline.h"

#include <cmath>

#include <gtest/gtest.h>

#include "regolith/core/random.h"

namespace regolith {
namespace {

using Spline = UniformSpline<2>;

Spline RandomSpline() {
  Random random(4);
  std::vector<Spline::Vector> controls;
  for (int i = 0; i < 30; ++i) controls.emplace_back(random.Gaussian(), random.Gaussian());
  return Spline(controls, 0.1);
}

TEST(UniformBasis, IsAPartitionOfUnity) {
  for (const double u : {0.0, 0.3, 0.999}) {
    double sum = 0.0;
    for (const double weight : UniformBasis<5>(u)) {
      EXPECT_GE(weight, 0.0);
      sum += weight;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(UniformSpline, DerivativesAreThoseOfItsValues) {
  const Spline spline = RandomSpline();
  const double step = 1e-5;
  for (double time = 0.31; time < 2.5; time += 0.0737) {
    const auto before = spline.At(time - step);
    const auto after = spline.At(time + step);
    const auto here = spline.At(time);
    EXPECT_LT((here.first - (after.value - before.value) / (2 * step)).norm(), 1e-5);
    EXPECT_LT((here.second - (after.first - before.first) / (2 * step)).norm(), 1e-4);
  }
}

TEST(UniformSpline, IsThreeTimesContinuouslyDifferentiableAtItsKnots) {
  const Spline spline = RandomSpline();
  const double step = 1e-4;
  for (const double knot : {0.5, 1.0, 1.7}) {
    const Spline::Vector third_left =
        (spline.At(knot - step).second - spline.At(knot - 2 * step).second) / step;
    const Spline::Vector third_right =
        (spline.At(knot + 2 * step).second - spline.At(knot + step).second) / step;
    const double scale = third_left.norm() + 1.0;
    EXPECT_LT((third_left - third_right).norm(), 0.05 * scale) << knot;
  }
}

TEST(UniformSpline, RestsExactlyWhereItsControlsRest) {
  const std::vector<Spline::Vector> controls(10, Spline::Vector(1.0 / 3.0, -0.7));
  const auto value = Spline(controls, 0.1).At(0.437);
  EXPECT_EQ(value.value, controls[0]);
  EXPECT_EQ(value.first, Spline::Vector::Zero());
  EXPECT_EQ(value.second, Spline::Vector::Zero());
}

TEST(UniformSpline, MoreControlsChangeNothingThatIsSettled) {
  UniformSpline<1> spline({Eigen::Matrix<double, 1, 1>(1.0), Eigen::Matrix<double, 1, 1>(2.0),
                           Eigen::Matrix<double, 1, 1>(5.0), Eigen::Matrix<double, 1, 1>(3.0),
                           Eigen::Matrix<double, 1, 1>(4.0)},
                          0.5);
  const double settled = spline.settled();
  EXPECT_EQ(settled, 1.0);
  const UniformSpline<1> before = spline;
  spline.Append(Eigen::Matrix<double, 1, 1>(100.0));
  for (double time = 0.0; time < settled; time += 0.1) {
    EXPECT_EQ(spline.At(time).value, before.At(time).value);
    EXPECT_EQ(spline.At(time).second, before.At(time).second);
  }
  EXPECT_NE(spline.At(settled + 0.1).value, before.At(settled + 0.1).value);
}

}  // namespace
}  // namespace regolith
