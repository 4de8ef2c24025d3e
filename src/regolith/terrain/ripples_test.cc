// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/ripples.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "regolith/terrain/clods.h"

namespace regolith {
namespace {

TEST(RippleField, HasPatchesOfTheHeightAskedFor) {
  RippleOptions options;
  options.mega_height = 0.15;
  const RippleField field(options, 3);
  const PostBlock block{-300.0, -300.0, 0.5, 1200, 1200};
  std::vector<double> heights(block.size(), 0.0);
  field.AddTo(block, heights.data());
  double covered = 0.0;
  for (const double height : heights) covered += height != 0.0 ? 1.0 : 0.0;
  EXPECT_GT(covered / static_cast<double>(block.size()), 0.3);
  EXPECT_LT(covered / static_cast<double>(block.size()), 0.7);
  const auto range = std::minmax_element(heights.begin(), heights.end());
  EXPECT_NEAR(*range.second - *range.first, 0.15, 0.02);
}

TEST(RippleField, HasALeeSteeperThanItsStoss) {
  RippleOptions options;
  options.dune_height = 1.2;
  options.direction_deg = 0.0;
  const RippleField field(options, 3);
  double up = 0.0;
  double down = 0.0;
  for (double x = 0.0; x < 3000.0; x += 0.25) {
    const double slope = (field.Height(x + 0.25, 7.0, 0.0) - field.Height(x, 7.0, 0.0)) / 0.25;
    up = std::max(up, slope);
    down = std::max(down, -slope);
  }
  EXPECT_GT(down, 1.15 * up);
  EXPECT_LT(std::atan(down), 15.0 * M_PI / 180.0);
}

TEST(RippleField, GivesBlocksWhatItGivesPosts) {
  RippleOptions options;
  options.height = 0.012;
  options.mega_height = 0.15;
  options.dune_height = 1.2;
  const RippleField field(options, 3);
  const PostBlock block{4.0, -9.0, 0.04, 60, 50};
  std::vector<double> heights(block.size(), 0.0);
  field.AddTo(block, heights.data());
  for (size_t k = 0; k < heights.size(); ++k) {
    const double x = block.x + static_cast<double>(k % 60) * block.spacing;
    const double y = block.y + static_cast<double>(k / 60) * block.spacing;
    EXPECT_NEAR(heights[k], field.Height(x, y, block.spacing), 5e-6);
  }
}

TEST(ClodField, CoversTheShareOfItsLawAndGivesBlocksWhatItGivesPosts) {
  const ClodField field(ClodOptions{}, 3);
  const PostBlock block{4.0, -9.0, 0.005, 800, 800};
  std::vector<double> heights(block.size(), 0.0);
  field.AddTo(block, heights.data());
  double covered = 0.0;
  for (size_t k = 0; k < heights.size(); ++k) {
    covered += heights[k] > 0.0 ? 1.0 : 0.0;
    if (k % 97 != 0) continue;
    const double x = block.x + static_cast<double>(k % 800) * block.spacing;
    const double y = block.y + static_cast<double>(k / 800) * block.spacing;
    EXPECT_NEAR(heights[k], field.Height(x, y, block.spacing), 1e-9);
  }
  // ∫ π D² / 4 dN for N(> D) = 40 (D / 1 cm)^-2.1 from 1 to 5 cm.
  const double expected = M_PI / 4.0 * 40.0 * 1e-4 * 2.1 / 0.1 * (1.0 - std::pow(5.0, -0.1));
  EXPECT_NEAR(covered / static_cast<double>(block.size()), expected, 0.15 * expected);
  EXPECT_EQ(field.Height(4.0, 5.0, 0.08), 0.0);
}

}  // namespace
}  // namespace regolith
