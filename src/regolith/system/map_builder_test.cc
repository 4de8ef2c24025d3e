// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/map_builder.h"

#include <gtest/gtest.h>

namespace regolith {
namespace {

std::vector<MapPoint> Line(int count, float step) {
  std::vector<MapPoint> points(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i)
    points[static_cast<size_t>(i)].position.x() = step * static_cast<float>(i);
  return points;
}

TEST(MapBuilder, KeepsOnePointAVoxel) {
  MapBuilder map({1.0, 1000});
  map.Add(Line(100, 0.25F));
  EXPECT_EQ(map.points().size(), 25U);
  map.Add(Line(100, 0.25F));
  EXPECT_EQ(map.points().size(), 25U);
}

TEST(MapBuilder, GrowsItsVoxelsInsteadOfItsMemory) {
  MapBuilder map({1.0, 100});
  map.Add(Line(1000, 1.0F));
  EXPECT_LE(map.points().size(), 101U);
  EXPECT_EQ(map.voxel_size(), 16.0);
}

}  // namespace
}  // namespace regolith
