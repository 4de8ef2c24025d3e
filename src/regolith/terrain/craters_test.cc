// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/craters.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace regolith {
namespace {

double HeightAt(const Crater& crater, double x) { return CraterHeight(crater, {x, 0.0}); }

TEST(CraterHeight, OfAFreshCraterHasItsDepthAndRimAndEnds) {
  Crater crater;
  crater.diameter = 4.0;
  crater.depth = 0.12F;
  double highest = 0.0;
  for (double x = 0.0; x < 5.0; x += 0.01) highest = std::max(highest, HeightAt(crater, x));
  EXPECT_NEAR(highest - HeightAt(crater, 0.0), 4.0 * 0.12, 0.01);
  // Fassett and Thomson 2014: the rim is .036 / .217 of the depth.
  EXPECT_NEAR(highest, 4.0 * 0.12 * 0.036 / 0.217, 0.01);
  EXPECT_GT(HeightAt(crater, 3.0), 0.0);
  EXPECT_EQ(HeightAt(crater, 2.0 * kCraterReach + 0.01), 0.0);
}

TEST(CraterHeight, IsOnceDifferentiable) {
  const Crater crater{Eigen::Vector2d::Zero(), 2.0, 0.1F, 1.0F};
  const double step = 1e-3;
  for (double x = 0.0; x < 2.5; x += 0.0123) {
    const double left = (HeightAt(crater, x) - HeightAt(crater, x - step)) / step;
    const double right = (HeightAt(crater, x + step) - HeightAt(crater, x)) / step;
    EXPECT_NEAR(left, right, 0.012) << x;
  }
}

TEST(CraterHeight, LosesItsRimBeforeItsBowl) {
  const Crater fresh{Eigen::Vector2d::Zero(), 2.0, 0.12F, 1.0F};
  const Crater old{Eigen::Vector2d::Zero(), 2.0, 0.048F, 0.4F};
  EXPECT_LT(HeightAt(old, 1.0) / HeightAt(fresh, 1.0), 0.6 * 0.4);
}

TEST(CraterField, HasTheMeanDepthThatIsObserved) {
  // Wu et al. 2021 (Chang'e-4): .061; Mahanti et al. 2018, class C: .06.
  CraterOptions options;
  options.min_diameter = 20.0;
  options.max_diameter = 100.0;
  const CraterField field(options, 3, {Eigen::Vector2d(0, 0), Eigen::Vector2d(4000.0, 4000.0)});
  EXPECT_NEAR(field.MeanDepth(), 0.06, 0.01);
}

TEST(CraterField, AddsTheSameToABlockAsToItsPosts) {
  const CraterField field(CraterOptions{}, 3, {Eigen::Vector2d(-50, -50), Eigen::Vector2d(50, 50)});
  const PostBlock block{-7.0, 11.0, 0.1, 120, 90};
  std::vector<double> heights(block.size(), 0.0);
  field.AddTo(block, 0.4, heights.data());
  for (int j = 0; j < block.rows; j += 7) {
    for (int i = 0; i < block.columns; i += 7) {
      EXPECT_NEAR(heights[static_cast<size_t>(j * block.columns + i)],
                  field.Height(block.x + i * block.spacing, block.y + j * block.spacing, 0.4),
                  5e-6);
    }
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
  const double side = 1600.0 + 2.0 * kCraterReach * (1.0 + kCraterIrregularity);
  const double expected = options.density * (1.0 - 0.25) * side * side;
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
