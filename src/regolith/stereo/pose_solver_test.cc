// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/pose_solver.h"

#include <gtest/gtest.h>

#include "regolith/stereo/test_stereo_world_internal.h"

namespace regolith {
namespace {

std::vector<PointSighting> Sightings(const SE3& T_world_camera, size_t wrong) {
  Random random(11);
  std::vector<PointSighting> sightings;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d point(random.Uniform(-2, 2), random.Uniform(-1, 1),
                                random.Uniform(2, 10));
    PointSighting sighting;
    sighting.point_world = T_world_camera * point;
    sighting.seen = kTestCamera.Project(point);
    for (int axis = 0; axis < 3; ++axis) sighting.seen[axis] += random.Gaussian(0.0, 0.5);
    sighting.has_right = i % 3 != 0;
    if (sightings.size() < wrong) sighting.seen.y() += 30.0;
    sightings.push_back(sighting);
  }
  return sightings;
}

TEST(PoseSolver, FindsThePoseAmongWrongSightings) {
  const SE3 truth = TestCameraPose(1.0, 2.0, 0.4);
  const SE3 guess(truth.rotation * ExpSo3({0.02, -0.03, 0.01}),
                  truth.translation + Eigen::Vector3d(0.1, -0.05, 0.05));
  const PoseSolution solution = SolvePose(kTestCamera, Sightings(truth, 60), guess);
  EXPECT_LT((solution.T_world_camera.translation - truth.translation).norm(), 0.01);
  EXPECT_LT(AngleBetween(solution.T_world_camera.rotation, truth.rotation), 0.002);
  for (size_t i = 0; i < 60; ++i) EXPECT_EQ(solution.inliers[i], 0) << i;
  EXPECT_GT(solution.inlier_count, 130U);
}

TEST(PoseSolver, ASightingBehindTheCameraNeverFits) {
  PointSighting sighting;
  sighting.point_world = {0.0, 0.0, -1.0};
  EXPECT_GT(SquaredError(kTestCamera, SE3(), sighting), 1e30);
}

}  // namespace
}  // namespace regolith
