// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/voxel_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "regolith/core/random.h"

namespace regolith {
namespace {

std::vector<Eigen::Vector3d> RandomGround(int count, double half_side) {
  Random random(1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.Uniform(-half_side, half_side),
                        random.Uniform(-half_side, half_side), random.Gaussian(0.0, 0.05));
  }
  return points;
}

TEST(VoxelMap, NearestAgreesWithSearchingAllPoints) {
  VoxelMap map({});
  map.Add(RandomGround(20000, 10.0));
  const std::vector<Eigen::Vector3d> all = map.Points();
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d query(random.Uniform(-9, 9), random.Uniform(-9, 9),
                                random.Gaussian(0, 0.1));
    std::vector<double> distances;
    for (const Eigen::Vector3d& point : all) distances.push_back((point - query).norm());
    std::sort(distances.begin(), distances.end());
    const Neighbours found = map.Nearest(query, 8, 0.5);
    ASSERT_EQ(found.count, 8);
    for (size_t k = 0; k < 8; ++k) {
      EXPECT_NEAR(std::sqrt(found.squared_distances[k]), distances[k], 1e-4);
    }
  }
}

TEST(VoxelMap, KeepsAFewPointsAVoxelThatAreApart) {
  VoxelMapOptions options;
  options.voxel_size = 1.0;
  options.max_points_per_voxel = 5;
  VoxelMap map(options);
  map.Add(RandomGround(20000, 3.0));
  EXPECT_LE(map.Points().size(), 5 * map.voxel_count());
  const Eigen::Vector3d twin(0.5, 0.5, 0.5);
  VoxelMap twins(options);
  twins.Add(std::vector<Eigen::Vector3d>{twin, twin});
  EXPECT_EQ(twins.Points().size(), 1U);
}

TEST(VoxelMap, ForgetsWhatIsFar) {
  VoxelMapOptions options;
  options.radius = 5.0;
  VoxelMap map(options);
  map.Add(RandomGround(20000, 20.0));
  map.RemoveFarFrom({0.0, 0.0, 0.0});
  ASSERT_FALSE(map.empty());
  for (const Eigen::Vector3d& point : map.Points()) EXPECT_LT(point.norm(), 5.0 + 1.0);
  EXPECT_EQ(map.Nearest({15.0, 15.0, 0.0}, 5, 0.5).count, 0);
  EXPECT_EQ(map.Nearest({0.0, 0.0, 0.0}, 5, 0.5).count, 5);
  map.RemoveFarFrom({100.0, 0.0, 0.0});
  EXPECT_TRUE(map.empty());
}

}  // namespace
}  // namespace regolith
