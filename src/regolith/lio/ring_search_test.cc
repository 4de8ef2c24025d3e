// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/ring_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;

/// Rings of points on the plane z = 0.1 x - 1, elevations -20° … -11°.
std::vector<RingPoint> PlanePoints() {
  std::vector<RingPoint> points;
  for (int row = 0; row < 10; ++row) {
    for (int i = 0; i < 200; ++i) {
      const double azimuth = kTurn * i / 200.0;
      const double tangent = std::tan((-20.0 + row) * kTurn / 360.0);
      // z = ρ tan e = 0.1 ρ cos a - 1.
      const double radius = 1.0 / (0.1 * std::cos(azimuth) - tangent);
      points.push_back(
          {{radius * std::cos(azimuth), radius * std::sin(azimuth), radius * tangent}, row});
    }
  }
  return points;
}

TEST(RingSearch, FindsThePlaneOfTheRings) {
  const RingSearch search(PlanePoints());
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.1, 0.0, 1.0).normalized();
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const double azimuth = random.Uniform(0.0, kTurn);
    const double x = 3.3 * std::cos(azimuth);
    const Eigen::Vector3d query(x, 3.3 * std::sin(azimuth), 0.1 * x - 0.95);
    const FeaturePlane plane = search.FindPlane(query, 2.0);
    ASSERT_TRUE(plane.valid);
    EXPECT_NEAR(std::abs(plane.normal.dot(normal)), 1.0, 1e-9);
    EXPECT_NEAR(std::abs(plane.normal.dot(query - plane.point)), 0.05 * normal.z(), 1e-9);
  }
}

TEST(RingSearch, TheNearestPointIsThatOfABruteForceSearch) {
  Random random(2);
  std::vector<RingPoint> points;
  for (int i = 0; i < 500; ++i) {
    points.push_back(
        {{random.Uniform(-8, 8), random.Uniform(-8, 8), random.Uniform(-2, 2)}, i % 3});
  }
  const RingSearch search(points);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d query(random.Uniform(-8, 8), random.Uniform(-8, 8),
                                random.Uniform(-2, 2));
    double nearest = 1.5;
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    for (const RingPoint& point : points) {
      const double distance = (point.position - query).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      expected = point.position;
    }
    const FeatureLine line = search.FindLine(query, 1.5);
    if (!line.valid) continue;
    ++found;
    EXPECT_EQ(line.point, expected);
  }
  EXPECT_GT(found, 100);
}

TEST(RingSearch, FindsAnUprightEdgeAcrossTheSeam) {
  // Behind the lidar, where the azimuth jumps.
  std::vector<RingPoint> points;
  for (int row = 0; row < 16; ++row) points.push_back({{-5.0, 0.001, -1.0 + 0.17 * row}, row});
  const FeatureLine line = RingSearch(points).FindLine({-5.1, -0.1, 0.2}, 0.5);
  ASSERT_TRUE(line.valid);
  EXPECT_NEAR(std::abs(line.direction.z()), 1.0, 1e-9);
}

TEST(RingSearch, NothingFarOffAndNothingOfOneRing) {
  std::vector<RingPoint> points;
  for (int i = 0; i < 50; ++i) points.push_back({{4.0, 0.1 * i, 0.0}, 3});
  const RingSearch search(points);
  EXPECT_FALSE(search.FindLine({4.0, 1.0, 0.1}, 0.5).valid);
  EXPECT_FALSE(search.FindPlane({4.0, 1.0, 0.1}, 0.5).valid);
  const RingSearch plane(PlanePoints());
  EXPECT_FALSE(plane.FindPlane({3.0, 0.0, 2.0}, 1.0).valid);
  EXPECT_FALSE(RingSearch().FindPlane({3.0, 0.0, 2.0}, 1.0).valid);
}

}  // namespace
}  // namespace regolith
