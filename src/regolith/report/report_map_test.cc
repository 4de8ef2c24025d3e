// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/report_map.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace regolith {
namespace {

TEST(ReportMap, KeepsPlacesToWithinAStepOfTheBox) {
  std::vector<ReportMapPoint> points;
  for (int i = 0; i < 100; ++i) {
    const auto value = static_cast<float>(i);
    points.push_back({{value - 30.0F, 0.5F * value, -value}, 2.0F * value});
  }
  const PackedMap map = PackMap(points);
  ASSERT_EQ(map.count, 100U);
  ASSERT_EQ(map.bytes.size(), 800U);
  for (size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const uint8_t* bytes = &map.bytes[8 * i + 2 * static_cast<size_t>(axis)];
      const float share = static_cast<float>(bytes[0] + 256 * bytes[1]) / 65535.0F;
      EXPECT_NEAR(map.low[axis] + share * (map.high[axis] - map.low[axis]),
                  points[i].position[axis], 0.001F);
    }
  }
  EXPECT_FLOAT_EQ(map.heights[0], -97.0F);
  EXPECT_FLOAT_EQ(map.heights[1], -2.0F);
  EXPECT_EQ(map.bytes[6], 0);
  EXPECT_EQ(map.bytes[8 * 99 + 6], 255);
}

TEST(ReportMap, OfEqualPointsOrNoneIsFinite) {
  EXPECT_EQ(PackMap({}).count, 0U);
  const std::vector<ReportMapPoint> points(5);
  const PackedMap map = PackMap(points);
  EXPECT_GT(map.heights[1], map.heights[0]);
  EXPECT_EQ(map.bytes.size(), 40U);
}

TEST(ReportMap, ThinsEvenlyButNotEveryNth) {
  EXPECT_EQ(ThinEvenly(3, 10), (std::vector<size_t>{0, 1, 2}));
  const std::vector<size_t> kept = ThinEvenly(1000, 100);
  ASSERT_EQ(kept.size(), 100U);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(std::adjacent_find(kept.begin(), kept.end()), kept.end());
  std::vector<size_t> steps;
  for (size_t i = 1; i < kept.size(); ++i) steps.push_back(kept[i] - kept[i - 1]);
  EXPECT_NE(*std::min_element(steps.begin(), steps.end()),
            *std::max_element(steps.begin(), steps.end()));
  EXPECT_LE(*std::max_element(steps.begin(), steps.end()), 20U);
  EXPECT_EQ(kept, ThinEvenly(1000, 100));
}

}  // namespace
}  // namespace regolith
