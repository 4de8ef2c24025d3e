// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/scan_matcher.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

std::vector<VoxelMap> FlatMap() {
  std::vector<VoxelMap> map;
  map.emplace_back(VoxelMapOptions());
  std::vector<Eigen::Vector3d> points;
  for (double x = -12.0; x <= 12.0; x += 0.1) {
    for (double y = -12.0; y <= 12.0; y += 0.1) points.emplace_back(x, y, 0.0);
  }
  map[0].Add(points, Eigen::Vector3d::Zero());
  return map;
}

std::vector<Eigen::Vector3d> FlatScan(double height) {
  Random random(1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 800; ++i) {
    points.emplace_back(random.Uniform(-10, 10), random.Uniform(-10, 10), height);
  }
  return points;
}

Matrix6d PriorCovariance() { return Matrix6d::Identity() * 0.01; }

TEST(ScanMatcher, WhatTheScanDoesNotSeeStaysAsThePriorHasIt) {
  const std::vector<VoxelMap> map = FlatMap();
  ThreadPool threads(1);
  const SE3 prior(Eigen::Quaterniond::Identity(), {0.3, -0.2, 1.1});
  // The ground lies 1 m below the sensor; the prior says 1.1 m.
  const ScanMatch match = MatchScan(FlatScan(-1.0), prior, PriorCovariance(), map, {}, &threads);
  ASSERT_TRUE(match.used_scan);
  EXPECT_NEAR(match.T_map_body.translation.z(), 1.0, 0.005);
  EXPECT_NEAR(match.T_map_body.translation.x(), 0.3, 1e-6);
  EXPECT_NEAR(match.T_map_body.translation.y(), -0.2, 1e-6);
  EXPECT_EQ(match.observable.degenerate_directions, 3);
  EXPECT_NEAR(match.covariance(3, 3), 0.01, 1e-4);
  EXPECT_LT(match.covariance(5, 5), 1e-4);
}

TEST(ScanMatcher, TooFewMatchesLeaveThePrior) {
  const std::vector<VoxelMap> map = FlatMap();
  ThreadPool threads(1);
  const SE3 prior(Eigen::Quaterniond::Identity(), {0.0, 0.0, 9.0});
  const ScanMatch match = MatchScan(FlatScan(-1.0), prior, PriorCovariance(), map, {}, &threads);
  EXPECT_FALSE(match.used_scan);
  EXPECT_EQ(match.T_map_body.translation, prior.translation);
  EXPECT_EQ(match.covariance, PriorCovariance());
}

}  // namespace
}  // namespace regolith
