// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/feature_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

/// Ground, two walls and an upright edge, with noise of 1 cm.
FeatureCloud Yard(uint64_t seed, bool walls) {
  Random random(seed);
  const auto noise = [&] { return random.Gaussian(0.0, 0.01); };
  FeatureCloud cloud;
  for (double x = -8.0; x < 8.0; x += 0.45) {
    for (double y = -8.0; y < 8.0; y += 0.45) cloud.planars.emplace_back(x, y, noise());
  }
  if (!walls) return cloud;
  for (double along = -8.0; along < 8.0; along += 0.45) {
    for (double z = 0.2; z < 3.0; z += 0.45) {
      cloud.planars.emplace_back(8.0 + noise(), along, z);
      cloud.planars.emplace_back(along, 8.0 + noise(), z);
    }
  }
  for (double z = 0.0; z < 3.0; z += 0.21) {
    cloud.edges.emplace_back(8.0 + noise(), 8.0 + noise(), z);
    cloud.edges.emplace_back(noise() - 3.0, noise() + 2.0, z);
  }
  return cloud;
}

FeatureCloud Seen(const FeatureCloud& cloud_map, const SE3& T_map_lidar) {
  FeatureCloud seen;
  for (const auto& point : cloud_map.edges) seen.edges.push_back(T_map_lidar.Inverse() * point);
  for (const auto& point : cloud_map.planars) seen.planars.push_back(T_map_lidar.Inverse() * point);
  return seen;
}

const SE3 kTruth(ExpSo3({0.05, -0.03, 0.4}), {1.0, -0.5, 1.2});

Vector6d Offset() {
  Vector6d offset;
  offset << 0.02, -0.02, 0.03, 0.15, -0.2, 0.1;
  return offset;
}

TEST(FeatureMap, BringsAScanOntoTheMap) {
  ThreadPool threads(2);
  FeatureMap map{FeatureMapOptions()};
  EXPECT_TRUE(map.empty());
  map.Add(Yard(1, true), SE3());
  const MapMatch match = map.Match(Seen(Yard(2, true), kTruth), Plus(kTruth, Offset()), &threads);
  EXPECT_TRUE(match.used_scan);
  EXPECT_EQ(match.degenerate_directions, 0);
  const Vector6d error = Minus(match.T_map_lidar, kTruth);
  EXPECT_LT(error.head<3>().norm(), 0.003);
  EXPECT_LT(error.tail<3>().norm(), 0.015);
}

TEST(FeatureMap, AddedScansMayLieAnywhere) {
  ThreadPool threads(1);
  const SE3 T_map_first(ExpSo3({0.0, 0.0, 1.0}), {30.0, 0.0, 0.0});
  FeatureMap map{FeatureMapOptions()};
  map.Add(Seen(Yard(1, true), kTruth), T_map_first * kTruth);
  const MapMatch match =
      map.Match(Seen(Yard(2, true), kTruth), T_map_first * Plus(kTruth, Offset()), &threads);
  EXPECT_LT(Minus(match.T_map_lidar, T_map_first * kTruth).norm(), 0.02);
}

TEST(FeatureMap, OnePlaneKeepsTheGuessAlongItAndSaysSo) {
  ThreadPool threads(2);
  FeatureMapOptions options;
  options.min_eigenvalue = 0.02;
  FeatureMap map(options);
  map.Add(Yard(1, false), SE3());
  const SE3 guess = Plus(kTruth, Offset());
  const MapMatch match = map.Match(Seen(Yard(2, false), kTruth), guess, &threads);
  EXPECT_TRUE(match.used_scan);
  EXPECT_EQ(match.degenerate_directions, 3);
  const Eigen::Vector3d moved = match.T_map_lidar.translation - guess.translation;
  EXPECT_LT(moved.head<2>().norm(), 0.01);
  EXPECT_NEAR(match.T_map_lidar.translation.z(), kTruth.translation.z(), 0.02);
}

TEST(FeatureMap, TooFewFeaturesLeaveTheGuess) {
  ThreadPool threads(1);
  FeatureMap map{FeatureMapOptions()};
  const SE3 guess = Plus(kTruth, Offset());
  EXPECT_FALSE(map.Match(Seen(Yard(2, true), kTruth), guess, &threads).used_scan);
  map.Add(Yard(1, true), SE3());
  const MapMatch match = map.Match(FeatureCloud(), guess, &threads);
  EXPECT_FALSE(match.used_scan);
  EXPECT_EQ(match.T_map_lidar.translation, guess.translation);
}

TEST(FeatureMap, ForgetsWhatIsFar) {
  ThreadPool threads(1);
  FeatureMap map{FeatureMapOptions()};
  map.Add(Yard(1, true), SE3());
  map.ForgetFarFrom({200.0, 0.0, 0.0});
  EXPECT_TRUE(map.empty());
}

}  // namespace
}  // namespace regolith
