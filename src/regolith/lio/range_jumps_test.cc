// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/range_jumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace regolith {
namespace {

/// One ring of a beam every 0.2 degrees over 20 degrees; `range` of a beam's number, 0: no return.
LidarScan RingOf(const std::function<double(int)>& range) {
  LidarScan scan;
  for (int i = 0; i < 100; ++i) {
    if (range(i) <= 0.0) continue;
    const double azimuth = i * 0.0035;
    LidarPoint point;
    point.position =
        (range(i) * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), -0.2)).cast<float>();
    point.ring = 3;
    scan.points.push_back(point);
  }
  return scan;
}

TEST(RangeJumps, ARocksEdgesAreLeftOut) {
  const auto kept =
      PointsOffRangeJumps(RingOf([](int i) { return i >= 40 && i < 50 ? 5.0 : 5.4; }), {});
  ASSERT_EQ(kept.size(), 96U);
  for (const uint32_t edge : {39U, 40U, 49U, 50U}) {
    EXPECT_EQ(std::count(kept.begin(), kept.end(), edge), 0) << edge;
  }
}

TEST(RangeJumps, InclinedGroundAndNoiseStay) {
  const auto inclined = [](int i) { return 10.0 + 1.2 * 10.0 * 0.0035 * i; };
  EXPECT_EQ(PointsOffRangeJumps(RingOf(inclined), {}).size(), 100U);
  const auto noisy = [](int i) { return 6.0 + (i % 2 == 0 ? 0.03 : -0.03); };
  EXPECT_EQ(PointsOffRangeJumps(RingOf(noisy), {}).size(), 100U);
}

TEST(RangeJumps, WhatLiesFarApartIsNoJump) {
  const auto gap = [](int i) { return i < 40 ? 5.0 : i < 60 ? 0.0 : 8.0; };
  EXPECT_EQ(PointsOffRangeJumps(RingOf(gap), {}).size(), 80U);
}

TEST(RangeJumps, RingsAreLookedAtOneByOne) {
  LidarScan scan = RingOf([](int) { return 5.0; });
  for (size_t i = 0; i < scan.points.size(); i += 2) {
    scan.points[i].ring = 4;
    scan.points[i].position *= 2.0F;
  }
  EXPECT_EQ(PointsOffRangeJumps(scan, {}).size(), 100U);
  EXPECT_TRUE(PointsOffRangeJumps(LidarScan(), {}).empty());
}

}  // namespace
}  // namespace regolith
