// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/point_to_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Cholesky>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

// Rolling ground: every direction is constrained.
Eigen::Vector3d GroundPoint(double x, double y) {
  return {x, y, 0.6 * std::sin(0.4 * x) + 0.5 * std::cos(0.5 * y)};
}

std::vector<VoxelMap> GroundMap(bool flat) {
  std::vector<VoxelMap> map;
  map.emplace_back(VoxelMapOptions());
  std::vector<Eigen::Vector3d> points;
  for (double x = -15.0; x <= 15.0; x += 0.1) {
    for (double y = -15.0; y <= 15.0; y += 0.1) {
      points.push_back(flat ? Eigen::Vector3d(x, y, 0.0) : GroundPoint(x, y));
    }
  }
  map[0].Add(points, Eigen::Vector3d::Zero());
  return map;
}

std::vector<Eigen::Vector3d> Scan(const SE3& T_map_body, double sigma, bool flat) {
  Random random(5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 2000; ++i) {
    const double x = random.Uniform(-12, 12);
    const double y = random.Uniform(-12, 12);
    Eigen::Vector3d point = flat ? Eigen::Vector3d(x, y, 0.0) : GroundPoint(x, y);
    point.z() += random.Gaussian(0.0, sigma);
    points.push_back(T_map_body.Inverse() * point);
  }
  return points;
}

PointToPlaneSystem Linearize(const std::vector<Eigen::Vector3d>& points, const SE3& pose,
                             Span<const VoxelMap> maps, ThreadPool* threads) {
  std::vector<PlaneMatch> planes;
  FindPlanes(points, pose, maps, {}, threads, &planes);
  return LinearizePointToPlane(points, planes, pose, {}, threads);
}

SE3 TruePose() { return {ExpSo3({0.02, -0.03, 0.3}), {0.5, -0.4, 1.2}}; }

TEST(PointToPlane, GaussNewtonConvergesToTheTruePose) {
  const std::vector<VoxelMap> map = GroundMap(false);
  const auto points = Scan(TruePose(), 0.02, false);
  ThreadPool threads(2);
  Vector6d offset;
  offset << 0.01, -0.01, 0.02, 0.15, -0.1, 0.1;
  SE3 pose = Plus(TruePose(), offset);
  for (int i = 0; i < 15; ++i) {
    const auto system = Linearize(points, pose, map, &threads);
    pose = Plus(pose, -system.information.ldlt().solve(system.gradient));
  }
  EXPECT_LT((pose.translation - TruePose().translation).norm(), 0.02);
  EXPECT_LT(AngleBetween(pose.rotation, TruePose().rotation), 0.002);
}

TEST(PointToPlane, OutliersLoseTheirWeight) {
  const std::vector<VoxelMap> map = GroundMap(false);
  auto points = Scan(TruePose(), 0.01, false);
  const auto clean = [&] {
    ThreadPool threads(1);
    return Linearize(points, TruePose(), map, &threads);
  }();
  for (size_t i = 0; i < points.size(); i += 5) {
    points[i] = TruePose().Inverse() * (TruePose() * points[i] + Eigen::Vector3d(0.0, 0.0, 0.3));
  }
  ThreadPool threads(1);
  const auto dirty = Linearize(points, TruePose(), map, &threads);
  const Vector6d shift = dirty.information.ldlt().solve(dirty.gradient);
  EXPECT_GT(clean.inliers, dirty.inliers);
  // Unweighted, a fifth of the points 0.3 m too high would pull the pose by 0.06 m.
  EXPECT_LT(std::abs(shift[5]), 0.01);
}

TEST(PointToPlane, FlatGroundLeavesItsThreeDirectionsOpen) {
  const std::vector<VoxelMap> map = GroundMap(true);
  ThreadPool threads(1);
  const auto system = Linearize(Scan(SE3(), 0.0, true), SE3(), map, &threads);
  EXPECT_LT(system.information(3, 3), 1e-6 * system.information(5, 5));
  EXPECT_LT(system.information(4, 4), 1e-6 * system.information(5, 5));
  EXPECT_LT(system.information(2, 2), 1e-6 * system.information(0, 0));
}

TEST(PointToPlane, SameBytesForAnyNumberOfThreads) {
  const std::vector<VoxelMap> map = GroundMap(false);
  const auto points = Scan(TruePose(), 0.02, false);
  ThreadPool one(1);
  ThreadPool three(3);
  const auto first = Linearize(points, TruePose(), map, &one);
  const auto second = Linearize(points, TruePose(), map, &three);
  EXPECT_EQ(first.information, second.information);
  EXPECT_EQ(first.gradient, second.gradient);
}

std::vector<Eigen::Vector3d> Ring(double height) {
  std::vector<Eigen::Vector3d> ring;
  for (double angle = 0.0; angle < 6.28; angle += 0.003) {
    ring.emplace_back(5.0 * std::cos(angle), 5.0 * std::sin(angle), height);
  }
  return ring;
}

TEST(PointToPlane, ARingAloneMakesNoPlane) {
  std::vector<VoxelMap> map;
  map.emplace_back(VoxelMapOptions());
  map[0].Add(Ring(0.0), Eigen::Vector3d::Zero());
  ThreadPool threads(1);
  EXPECT_EQ(Linearize(Ring(0.0), SE3(), map, &threads).matches, 0);
}

TEST(PointToPlane, RingsApartMakePlanesInACoarserMap) {
  VoxelMapOptions coarse;
  coarse.voxel_size = 1.5;
  std::vector<VoxelMap> maps;
  maps.emplace_back(VoxelMapOptions());
  maps.emplace_back(coarse);
  for (VoxelMap& map : maps) {
    map.Add(Ring(0.0), Eigen::Vector3d::Zero());
    map.Add(Ring(0.6), Eigen::Vector3d::Zero());
  }
  ThreadPool threads(1);
  const auto fine = Linearize(Ring(0.0), SE3(), {maps.data(), 1}, &threads);
  const auto both = Linearize(Ring(0.0), SE3(), maps, &threads);
  EXPECT_EQ(fine.matches, 0);
  EXPECT_GT(both.matches, both.points / 2);
}

}  // namespace
}  // namespace regolith
