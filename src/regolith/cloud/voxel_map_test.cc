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
  map.Add(RandomGround(20000, 10.0), Eigen::Vector3d::Zero());
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
  map.Add(RandomGround(20000, 3.0), Eigen::Vector3d::Zero());
  EXPECT_LE(map.Points().size(), 5 * map.voxel_count());
  const Eigen::Vector3d twin(0.5, 0.5, 0.5);
  VoxelMap twins(options);
  twins.Add(std::vector<Eigen::Vector3d>{twin, twin}, Eigen::Vector3d::Zero());
  EXPECT_EQ(twins.Points().size(), 1U);
}

TEST(VoxelMap, ForgetsWhatIsFar) {
  VoxelMapOptions options;
  options.radius = 30.0;
  VoxelMap map(options);
  map.Add(RandomGround(20000, 15.0), Eigen::Vector3d::Zero());
  const Eigen::Vector3d moved(25.0, 0.0, 0.0);
  map.ForgetFarFrom(moved);
  ASSERT_FALSE(map.empty());
  for (const Eigen::Vector3d& point : map.Points()) EXPECT_LT((point - moved).norm(), 30.0 + 1.0);
  EXPECT_EQ(map.Nearest({-14.0, -14.0, 0.0}, 5, 0.5).count, 0);
  EXPECT_EQ(map.Nearest({5.0, 0.0, 0.0}, 5, 0.5).count, 5);
  map.ForgetFarFrom({100.0, 0.0, 0.0});
  EXPECT_TRUE(map.empty());
}

TEST(VoxelMap, ForgettingInSharesForgetsTheSame) {
  VoxelMapOptions options;
  options.radius = 20.0;
  VoxelMap at_once(options);
  VoxelMap in_shares(options);
  const auto ground = RandomGround(20000, 12.0);
  at_once.Add(ground, Eigen::Vector3d::Zero());
  in_shares.Add(ground, Eigen::Vector3d::Zero());
  const Eigen::Vector3d moved(15.0, 5.0, 0.0);
  at_once.ForgetFarFrom(moved);
  for (int i = 0; i < 16; ++i) in_shares.ForgetSomeFarFrom(moved);
  EXPECT_EQ(in_shares.voxel_count(), at_once.voxel_count());
  EXPECT_EQ(in_shares.Points(), at_once.Points());
}

TEST(VoxelMap, FindsEverythingAfterManyInsertionsAndRemovals) {
  VoxelMapOptions options;
  options.radius = 10.0;
  VoxelMap map(options);
  std::vector<Eigen::Vector3d> ground = RandomGround(4000, 8.0);
  for (int step = 0; step < 200; ++step) {
    const Eigen::Vector3d centre(0.7 * step, 0.0, 0.0);
    std::vector<Eigen::Vector3d> around = ground;
    for (Eigen::Vector3d& point : around) point += centre;
    map.Add(around, centre);
    map.ForgetSomeFarFrom(centre);
  }
  for (const Eigen::Vector3d& point : map.Points()) {
    const Neighbours found = map.Nearest(point, 1, 0.5);
    ASSERT_EQ(found.count, 1);
    EXPECT_EQ(found.squared_distances[0], 0.0);
  }
  // The whole way would be 17,000.
  EXPECT_LT(map.voxel_count(), 6000U);
}

TEST(VoxelMap, WhereMemoryIsShortTheRadiusShrinks) {
  VoxelMapOptions options;
  options.max_voxels = 1000;
  VoxelMap map(options);
  map.Add(RandomGround(50000, 20.0), Eigen::Vector3d::Zero());
  EXPECT_LE(map.voxel_count(), 1000U);
  EXPECT_LT(map.radius(), 20.0);
  EXPECT_EQ(map.Nearest({0.0, 0.0, 0.0}, 5, 0.5).count, 5);
}

}  // namespace
}  // namespace regolith
