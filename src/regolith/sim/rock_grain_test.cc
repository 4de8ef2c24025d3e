// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rock_grain.h"

#include <cmath>

#include <gtest/gtest.h>

namespace regolith {
namespace {

TEST(RockGrain, VariesAlongARockAndFromRockToRock) {
  double sum = 0.0;
  double squares = 0.0;
  double slopes = 0.0;
  int same = 0;
  constexpr int kPlaces = 4000;
  for (int i = 0; i < kPlaces; ++i) {
    const auto at = static_cast<float>(i);
    const Eigen::Vector3f place(std::sin(1.7F * at), std::sin(2.3F * at), std::sin(3.1F * at));
    const RockGrain grain = GrainOfRock(7, place, 0.004F);
    const double logarithm = std::log(static_cast<double>(grain.brightness));
    sum += logarithm;
    squares += logarithm * logarithm;
    slopes += static_cast<double>(grain.slope.squaredNorm());
    same += GrainOfRock(1234567, place, 0.004F).brightness == grain.brightness ? 1 : 0;
  }
  EXPECT_NEAR(sum / kPlaces, 0.0, 0.02);
  // Octaves of 10, 10, 9 and 8 %.
  EXPECT_NEAR(std::sqrt(squares / kPlaces), 0.186, 0.03);
  EXPECT_GT(slopes / kPlaces, 0.02);
  EXPECT_LT(same, kPlaces / 100);
}

TEST(RockGrain, IsAveragedOutByAWideFootprint) {
  const RockGrain grain = GrainOfRock(7, {0.3F, 0.1F, 0.2F}, 0.5F);
  EXPECT_EQ(grain.brightness, 1.0F);
  EXPECT_EQ(grain.slope.norm(), 0.0F);
}

}  // namespace
}  // namespace regolith
