// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/dem.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "regolith/core/error.h"

namespace regolith {
namespace {

constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

HeightGrid Plane(int size, double spacing) {
  HeightGrid grid;
  grid.columns = size;
  grid.rows = size;
  grid.spacing = spacing;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      grid.heights.push_back(static_cast<float>(0.1 * column * spacing - 0.05 * row * spacing));
    }
  }
  return grid;
}

TEST(Dem, ReproducesAPlaneWithNorthUp) {
  const Dem dem(Plane(21, 2.0));
  EXPECT_NEAR(dem.Height(0.0, 0.0), 0.0, 1e-6);
  EXPECT_NEAR(dem.Height(3.3, 0.0), 0.33, 1e-5);
  EXPECT_NEAR(dem.Height(0.0, 5.5), 0.05 * 5.5, 1e-5);
}

TEST(Dem, RepeatsItsBorderOutside) {
  const Dem dem(Plane(21, 2.0));
  EXPECT_DOUBLE_EQ(dem.Height(20.0, 0.0), dem.Height(200.0, 0.0));
}

TEST(Dem, KnowsItsHolesAndFillsThemForTheBackground) {
  HeightGrid grid = Plane(21, 1.0);
  grid.At(10, 10) = kHole;
  const Dem dem(grid);
  EXPECT_FALSE(dem.HasData(0.4, 0.4, 1.0));
  EXPECT_TRUE(dem.HasData(5.0, 5.0, 1.0));
  EXPECT_FALSE(dem.HasData(9.5, 0.0, 1.0));
  EXPECT_TRUE(std::isfinite(dem.Height(0.0, 0.0)));
}

TEST(Dem, RefusesAModelOfNoData) {
  HeightGrid grid = Plane(8, 1.0);
  for (float& height : grid.heights) height = kHole;
  EXPECT_THROW(Dem{grid}, InputError);
}

}  // namespace
}  // namespace regolith
