// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/ring_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "regolith/lio/test_scene_internal.h"

namespace regolith {
namespace {

double Sphere(const Eigen::Vector3d& point) { return 10.0 - point.norm(); }

LidarScan SphereScan(int rings, int columns) {
  TestLidar lidar;
  lidar.rings = rings;
  lidar.columns = columns;
  return CastScan(lidar, Sphere, 1, SE3());
}

void Shuffle(LidarScan* scan) {
  Random random(3);
  for (size_t i = scan->points.size(); i > 1; --i) {
    std::swap(scan->points[i - 1], scan->points[random.Next() % i]);
  }
}

/// Cells whose point is of their row, with ring = row, and whose azimuth is theirs or a
/// neighbour's.
int CountRightCells(const LidarScan& scan, const RingImage& image) {
  int right = 0;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const int32_t index = image.Index(row, column);
      if (index == RingImage::kEmpty) continue;
      const LidarPoint& point = scan.points[static_cast<size_t>(index)];
      const double azimuth = std::atan2(point.position.y(), point.position.x());
      const double centre = 2.0 * kTestPi * (column + 0.5) / image.columns;
      const double off = std::abs(std::remainder(azimuth - centre, 2.0 * kTestPi));
      if (point.ring == row && off * image.columns < 1.51 * 2.0 * kTestPi) ++right;
    }
  }
  return right;
}

TEST(RingImage, HoldsEveryPointOfAFullTurnInAnyOrder) {
  for (const int rings : {16, 32, 64}) {
    for (const int columns : {360, 900, 1800}) {
      LidarScan scan = SphereScan(rings, columns);
      ASSERT_EQ(scan.points.size(), static_cast<size_t>(rings * columns));
      Shuffle(&scan);
      const RingImage image = MakeRingImage(scan, rings);
      EXPECT_EQ(image.rows, rings);
      EXPECT_NEAR(image.columns, columns, 0.01 * columns);
      EXPECT_EQ(image.invalid_points, 0);
      EXPECT_LT(image.crowded_points, rings * columns / 100);
      EXPECT_EQ(CountRightCells(scan, image), rings * columns - image.crowded_points);
    }
  }
}

TEST(RingImage, KeepsItsColumnsWhenMostPointsAreMissing) {
  LidarScan scan = SphereScan(16, 900);
  Shuffle(&scan);
  scan.points.resize(scan.points.size() / 3);
  const RingImage image = MakeRingImage(scan, 16);
  EXPECT_NEAR(image.columns, 900, 9);
  EXPECT_GT(CountRightCells(scan, image), 0.97 * static_cast<double>(scan.points.size()));
}

TEST(RingImage, LeavesOutWhatIsNoPoint) {
  LidarScan scan = SphereScan(16, 360);
  const size_t count = scan.points.size();
  for (size_t i = 0; i < 100; ++i) {
    scan.points[7 * i].position.x() = std::numeric_limits<float>::quiet_NaN();
  }
  scan.points[5].position.setZero();
  scan.points[6].ring = 16;
  const RingImage image = MakeRingImage(scan, 16);
  EXPECT_EQ(image.invalid_points, 102);
  EXPECT_EQ(CountRightCells(scan, image), static_cast<int>(count) - 102);
}

TEST(RingImage, KeepsEveryPlaceOfAScanThatIsThereTwice) {
  LidarScan scan = SphereScan(16, 360);
  const size_t count = scan.points.size();
  scan.points.insert(scan.points.end(), scan.points.begin(), scan.points.end());
  const RingImage image = MakeRingImage(scan, 16);
  EXPECT_NEAR(image.columns, 360, 4);
  size_t filled = 0;
  for (const int32_t index : image.indices) filled += index != RingImage::kEmpty ? 1U : 0U;
  EXPECT_GE(filled, count);
}

TEST(RingImage, OrdersRingsByElevationAndSaysSo) {
  LidarScan scan = SphereScan(16, 360);
  EXPECT_FALSE(MakeRingImage(scan, 16).rings_reordered);
  for (LidarPoint& point : scan.points) point.ring = static_cast<uint16_t>((7 * point.ring) % 16);
  const RingImage image = MakeRingImage(scan, 16);
  EXPECT_TRUE(image.rings_reordered);
  EXPECT_TRUE(std::is_sorted(image.elevations.begin(), image.elevations.end()));
}

TEST(RingImage, OfNothingIsEmpty) {
  const RingImage image = MakeRingImage(LidarScan(), 16);
  EXPECT_EQ(image.rows, 0);
  EXPECT_TRUE(image.indices.empty());
}

TEST(RingImage, NextLooksAcrossTheSeam) {
  LidarScan scan = SphereScan(2, 360);
  const RingImage image = MakeRingImage(scan, 2);
  EXPECT_EQ(image.Next(0, image.columns - 1, 1, 2), 0);
  EXPECT_EQ(image.Next(0, 0, -1, 2), image.columns - 1);
}

}  // namespace
}  // namespace regolith
