// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/search_box.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace regolith {
namespace {

// 2 km of ground that is level but for what `height` says of (x, y), m.
template <typename Height>
HeightGrid Model(Height height) {
  HeightGrid grid;
  grid.columns = grid.rows = 201;
  grid.spacing = 10.0;
  grid.origin = {-1000.0, 1000.0};
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      grid.heights.push_back(
          static_cast<float>(height(10.0 * column - 1000.0, 1000.0 - 10.0 * row)));
    }
  }
  return grid;
}

TEST(SearchBox, IsTheCentreOfGentleGround) {
  const Dem dem(Model([](double x, double) { return 0.05 * x; }));
  const Eigen::AlignedBox2d box = SearchBox(dem);
  EXPECT_LT(box.center().norm(), 1e-9);
  EXPECT_NEAR(box.sizes().x(), 800.0, 1e-9);
}

TEST(SearchBox, AvoidsASteepCentre) {
  // A hill of 20 degrees about the centre and to the west, level in the east.
  const Dem dem(Model([](double x, double) { return 0.36 * std::min(x, 150.0); }));
  EXPECT_GT(SearchBox(dem).center().x(), 300.0);
}

TEST(SearchBox, AvoidsHoles) {
  const Dem dem(Model([](double, double y) {
    return std::abs(y) < 350.0 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  }));
  EXPECT_GT(std::abs(SearchBox(dem).center().y()), 300.0);
}

TEST(SearchBox, IsTheWholeOfASmallModel) {
  HeightGrid grid = Model([](double, double) { return 0.0; });
  grid.spacing = 0.1;
  EXPECT_NEAR(SearchBox(Dem(grid)).sizes().x(), 20.0, 1e-9);
}

}  // namespace
}  // namespace regolith
