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
  map.Add(Line(100, 0.25F), 0);
  EXPECT_EQ(map.points().size(), 25U);
  map.Add(Line(100, 0.25F), 0);
  EXPECT_EQ(map.points().size(), 25U);
}

TEST(MapBuilder, GrowsItsVoxelsInsteadOfItsMemory) {
  MapBuilder map({1.0, 100});
  map.Add(Line(1000, 1.0F), 0);
  EXPECT_LE(map.points().size(), 101U);
  EXPECT_EQ(map.voxel_size(), 16.0);
}

TEST(MapBuilder, PointsFollowTheirScans) {
  MapBuilder map({1.0, 100});
  std::vector<MapPoint> other = Line(300, 1.0F);
  for (MapPoint& point : other) point.position.y() = 30.0F;
  map.Add(Line(300, 1.0F), 0);
  map.Add(other, 1);
  // The voxels have grown meanwhile: points still know their scans.
  ASSERT_GT(map.voxel_size(), 1.0);
  const std::vector<SE3> corrections = {
      SE3(), SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, 2.0))};
  const std::vector<MapPoint> moved = map.Moved(corrections);
  ASSERT_EQ(moved.size(), map.points().size());
  for (const MapPoint& point : moved) {
    EXPECT_EQ(point.position.z(), point.position.y() > 15.0F ? 2.0F : 0.0F);
  }
}

}  // namespace
}  // namespace regolith
