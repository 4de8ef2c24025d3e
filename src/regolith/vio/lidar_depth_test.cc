// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/lidar_depth.h"

#include <gtest/gtest.h>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

/// The camera looks along world x, 15° down, 1.1 m above level ground; the lidar is above it.
SE3 CameraAt(double x) {
  const Eigen::Quaterniond R_world_level(
      (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished());
  return SE3(R_world_level * ExpSo3({-15.0 / 180.0 * M_PI, 0.0, 0.0}), {x, 0.0, 1.1});
}

std::vector<Eigen::Vector3f> GroundScan(double lidar_x, uint64_t seed) {
  std::vector<Eigen::Vector3f> points;
  Random random(seed);
  for (const double radius : {4.5, 5.2, 6.2, 7.6, 9.8, 13.7}) {
    for (double azimuth = -1.2; azimuth < 1.2; azimuth += 0.0035) {
      const double range = radius + random.Gaussian(0.0, 0.02);
      points.emplace_back(static_cast<float>(lidar_x + range * std::cos(azimuth)),
                          static_cast<float>(range * std::sin(azimuth)),
                          static_cast<float>(random.Gaussian(0.0, 0.005)));
    }
  }
  return points;
}

TEST(LidarDepth, GroundBeforeTheWheelsIsKnownAfterSomeMetres) {
  LidarDepth depth{LidarDepthOptions()};
  for (int i = 0; i <= 120; ++i) {
    const double x = 0.05 * i;
    depth.Add(FromSeconds(0.1 * i), GroundScan(x, static_cast<uint64_t>(i)), {x, 0.0, 1.2});
  }
  const SE3 T_world_camera = CameraAt(6.0);
  std::vector<Eigen::Vector3d> bearings;
  std::vector<double> truth;
  for (double x = 1.3; x < 4.0; x += 0.15) {
    for (double y = -0.6; y < 0.7; y += 0.2) {
      const Eigen::Vector3d point = T_world_camera.Inverse() * Eigen::Vector3d(6.0 + x, y, 0.0);
      bearings.push_back(point.normalized());
      truth.push_back(point.norm());
    }
  }
  const auto distances = depth.Distances(T_world_camera, bearings);
  size_t known = 0;
  for (size_t i = 0; i < distances.size(); ++i) {
    if (!distances[i]) continue;
    ++known;
    EXPECT_NEAR(distances[i]->distance, truth[i], 3.5 * distances[i]->sigma);
    EXPECT_LT(distances[i]->sigma, 0.1);
  }
  EXPECT_GT(known, distances.size() * 9 / 10);
}

TEST(LidarDepth, OneScanSaysNothingOfTheNearGround) {
  LidarDepth depth{LidarDepthOptions()};
  depth.Add(0, GroundScan(0.0, 1), {0.0, 0.0, 1.2});
  const SE3 T_world_camera = CameraAt(0.0);
  const Eigen::Vector3d near = T_world_camera.Inverse() * Eigen::Vector3d(2.0, 0.0, 0.0);
  const std::vector<Eigen::Vector3d> bearings = {near.normalized()};
  EXPECT_FALSE(depth.Distances(T_world_camera, bearings)[0]);
}

TEST(LidarDepth, AWallHidesTheGroundBehindIt) {
  LidarDepth depth{LidarDepthOptions()};
  std::vector<Eigen::Vector3f> points;
  for (float y = -1.0F; y < 1.0F; y += 0.02F) {
    for (float z = 0.0F; z < 1.5F; z += 0.06F) {
      points.emplace_back(3.0F, y, z);         // the wall
      points.emplace_back(5.0F + z, y, 0.0F);  // the ground, seen from elsewhere before
    }
  }
  depth.Add(0, points, {0.0, 0.0, 1.2});
  const SE3 T_world_camera = CameraAt(0.0);
  const Eigen::Vector3d ground = T_world_camera.Inverse() * Eigen::Vector3d(5.5, 0.1, 0.0);
  const std::vector<Eigen::Vector3d> bearings = {ground.normalized()};
  const auto distances = depth.Distances(T_world_camera, bearings);
  ASSERT_TRUE(distances[0]);
  const double to_wall = ground.norm() * 3.0 / 5.5;
  EXPECT_NEAR(distances[0]->distance, to_wall, 0.02);
}

TEST(LidarDepth, KeepsSecondsAndMetres) {
  LidarDepth depth{LidarDepthOptions()};
  for (int i = 0; i < 1000; ++i) {
    depth.Add(FromSeconds(0.1 * i), std::vector<Eigen::Vector3f>(10, {1.0F, 0.0F, 0.0F}),
              {0.05 * i, 0.0, 1.2});
  }
  EXPECT_NEAR(static_cast<double>(depth.scans()), 121.0, 2.0);
  for (int i = 0; i < 1000; ++i) {
    depth.Add(FromSeconds(100.0 + 0.1 * i), std::vector<Eigen::Vector3f>(10, {1.0F, 0.0F, 0.0F}),
              {50.0, 0.0, 1.2});
  }
  EXPECT_NEAR(static_cast<double>(depth.scans()), 121.0, 3.0);
}

}  // namespace
}  // namespace regolith
