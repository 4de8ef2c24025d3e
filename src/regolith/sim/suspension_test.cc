// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/suspension.h"

#include <cmath>

#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/test_surface_internal.h"

namespace regolith {
namespace {

RoverOptions Wheels(int count) {
  RoverOptions rover;
  rover.wheels = count;
  return rover;
}

class SuspensionTest : public testing::TestWithParam<int> {};

TEST_P(SuspensionTest, LiesInAPlaneThatIsInclined) {
  const TestSurface surface([](double x, double y) { return 0.1 * x + 0.05 * y; });
  const Stance stance = Suspension(surface, Wheels(GetParam())).At({2.0, 1.0}, 0.0);
  EXPECT_NEAR(stance.height, 0.25, 0.01);
  EXPECT_NEAR(stance.pitch, -std::atan(0.1), 1e-6);
  EXPECT_NEAR(stance.roll, std::atan(0.05), 1e-6);
  EXPECT_NEAR(stance.travel, 0.0, 1e-9);
}

TEST_P(SuspensionTest, RollsOverARockBySomeOfItsHeight) {
  TestSurface surface([](double, double) { return 0.0; });
  surface.Add({0.0, kHalfTrack}, 0.12);
  Suspension suspension(surface, Wheels(GetParam()));
  const RockTops tops(surface.RockShapes());
  const double top = tops.Top(surface.Rocks(surface.box(), 0.0)[0], 0.0, kHalfTrack);
  EXPECT_EQ(suspension.At({-2.0, 0.0}, 0.0).height, 0.0);
  // The left front wheel stands on the rock: the body goes up by a share, and rolls.
  const Stance stance = suspension.At({-kHalfWheelbase, 0.0}, 0.0);
  EXPECT_GT(stance.height, 0.1 * top);
  EXPECT_LT(stance.height, 0.5 * top);
  EXPECT_GT(stance.roll, 0.0);
  EXPECT_GT(stance.travel, 0.0);
  // Between the wheels nothing touches it.
  EXPECT_EQ(suspension.At({0.0, kHalfTrack}, 0.0).height, 0.0);
}

INSTANTIATE_TEST_SUITE_P(FourAndSix, SuspensionTest, testing::Values(4, 6));

TEST(RoverMotion, RefusesGroundOnWhichTheRoverCannotStand) {
  const TestSurface surface([](double x, double y) { return x > 1.0 && y > 0.0 ? 1.0 : 0.0; });
  std::vector<PlanarPose> path(30);
  for (size_t i = 0; i < path.size(); ++i) path[i].position.x() = 0.05 * static_cast<double>(i);
  EXPECT_THROW(RoverMotion(surface, path, Wheels(4), VibrationOptions{}, 1), InputError);
  EXPECT_THROW(RoverMotion(surface, path, Wheels(6), VibrationOptions{}, 1), InputError);
}

}  // namespace
}  // namespace regolith
