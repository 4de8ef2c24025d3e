// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/craters.h"

#include <cmath>

#include <gtest/gtest.h>

namespace regolith {
namespace {

TEST(CraterHeight, HasItsDepthAndRimAndEnds) {
  Crater crater;
  crater.diameter = 4.0;
  crater.depth = 0.12;
  crater.rim = 0.02;
  EXPECT_NEAR(CraterHeight(crater, 2.0), 4.0 * 0.02, 1e-9);
  EXPECT_NEAR(CraterHeight(crater, 2.0) - CraterHeight(crater, 0.0), 4.0 * 0.12, 0.001);
  EXPECT_NEAR(CraterHeight(crater, 2.0 * kCraterReach - 1e-6), 0.0, 1e-9);
  EXPECT_EQ(CraterHeight(crater, 10.0), 0.0);
}

TEST(CraterHeight, IsOnceDifferentiableAtItsRimAndEnd) {
  const Crater crater{Eigen::Vector2d::Zero(), 2.0, 0.1, 0.015};
  const double step = 1e-6;
  for (const double place : {1.0, kCraterReach}) {
    const double left = (CraterHeight(crater, place) - CraterHeight(crater, place - step)) / step;
    const double right = (CraterHeight(crater, place + step) - CraterHeight(crater, place)) / step;
    EXPECT_NEAR(left, right, 1e-4) << place;
  }
}

TEST(CraterField, HasTheDensityOfTheEquilibrium) {
  CraterOptions options;
  options.min_diameter = 1.0;
  options.max_diameter = 1024.0;
  options.density = 0.05;
  const Eigen::AlignedBox2d box(Eigen::Vector2d(0, 0), Eigen::Vector2d(10.0, 10.0));
  // Cells are drawn whole, so the field is judged by a box much larger than the cells it holds.
  options.max_diameter = 2.0;
  const CraterField field(options, 3, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1600.0, 1600.0)});
  const double expected = options.density * (1.0 - 0.25) * 1600.0 * 1600.0;
  EXPECT_NEAR(static_cast<double>(field.size()), expected, 0.05 * expected);
}

TEST(CraterField, IsTheSameInBoxesThatOverlap) {
  const CraterOptions options;
  const CraterField large(options, 3, {Eigen::Vector2d(-50, -50), Eigen::Vector2d(50, 50)});
  const CraterField small(options, 3, {Eigen::Vector2d(-5, -7), Eigen::Vector2d(9, 8)});
  for (double x = -4.9; x < 9.0; x += 0.37) {
    for (double y = -6.9; y < 8.0; y += 0.41) {
      EXPECT_NEAR(large.Height(x, y, 0.0), small.Height(x, y, 0.0), 1e-12);
    }
  }
}

}  // namespace
}  // namespace regolith
