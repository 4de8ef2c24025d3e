// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/feature_problem.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

const SE3 kTruth(ExpSo3({0.05, -0.1, 0.3}), {0.4, -0.2, 0.1});

Eigen::Vector3d RandomVector(Random* random, double size) {
  return {random->Uniform(-size, size), random->Uniform(-size, size), random->Uniform(-size, size)};
}

/// Lines and planes of the target, and points that lie on them at the true pose.
FeatureMatches ExactMatches(int lines, int planes, const Eigen::Vector3d* only_normal = nullptr) {
  Random random(4);
  FeatureMatches matches;
  for (int i = 0; i < lines; ++i) {
    const Eigen::Vector3d direction = RandomVector(&random, 1.0).normalized();
    const Eigen::Vector3d point = RandomVector(&random, 10.0);
    matches.lines.push_back({true, point, direction});
    matches.edges.push_back(kTruth.Inverse() * (point + random.Uniform(-2, 2) * direction));
  }
  for (int i = 0; i < planes; ++i) {
    const Eigen::Vector3d normal =
        only_normal ? *only_normal : Eigen::Vector3d(RandomVector(&random, 1.0).normalized());
    // All of one plane where only one normal is wanted.
    Eigen::Vector3d point = RandomVector(&random, 10.0);
    if (only_normal) point -= normal.dot(point) * normal;
    const Eigen::Vector3d across = normal.unitOrthogonal();
    matches.planes.push_back({true, point, normal});
    matches.planars.push_back(kTruth.Inverse() * (point + random.Uniform(-2, 2) * across));
  }
  return matches;
}

TEST(FeatureProblem, GradientIsThatOfTheCost) {
  FeatureMatches matches = ExactMatches(20, 30);
  matches.lines[3].valid = false;
  matches.planes[5].valid = false;
  Vector6d offset;
  offset << 0.01, -0.02, 0.015, 0.05, 0.1, -0.07;
  const SE3 pose = Plus(kTruth, offset);
  const double kernel = 0.3;
  const FeatureSystem system = Linearize(matches, pose, kernel);
  EXPECT_EQ(system.matches, 48);
  const double h = 1e-6;
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = h * Vector6d::Unit(i);
    const double slope = (Linearize(matches, Plus(pose, step), kernel).cost -
                          Linearize(matches, Plus(pose, -step), kernel).cost) /
                         (2.0 * h);
    EXPECT_NEAR(system.gradient[i], slope, 1e-5 * (1.0 + std::abs(slope))) << i;
  }
}

TEST(FeatureProblem, InformationIsTheCurvatureOfTheCostAtItsMinimum) {
  const FeatureMatches matches = ExactMatches(20, 30);
  const FeatureSystem system = Linearize(matches, kTruth, 1.0);
  EXPECT_NEAR(system.cost, 0.0, 1e-12);
  const double h = 1e-4;
  for (int i = 0; i < 6; ++i) {
    const double cost = Linearize(matches, Plus(kTruth, h * Vector6d::Unit(i)), 1.0).cost;
    EXPECT_NEAR(2.0 * cost / (h * h), system.information(i, i), 1e-3 * system.information(i, i));
  }
}

TEST(FeatureProblem, FindsThePoseDespiteWrongMatches) {
  FeatureMatches matches = ExactMatches(30, 60);
  for (int i = 0; i < 6; ++i) matches.planes[static_cast<size_t>(i)].point.z() += 2.0;
  Vector6d offset;
  offset << 0.02, -0.03, 0.03, 0.1, -0.1, 0.1;
  const SE3 found = MinimizeDistances(matches, Plus(kTruth, offset), MotionSubspace(), 0.3, 20);
  EXPECT_LT(Minus(found, kTruth).norm(), 0.01);
}

TEST(FeatureProblem, MovesWithinTheSubspaceAlone) {
  MotionSubspace subspace;
  subspace.projection.setZero();
  subspace.projection(2, 2) = subspace.projection(3, 3) = 1.0;  // yaw and x
  Vector6d offset;
  offset << 0.02, -0.01, 0.03, 0.1, -0.05, 0.02;
  const SE3 start = Plus(kTruth, offset);
  const Vector6d change =
      Minus(MinimizeDistances(ExactMatches(20, 20), start, subspace, 1.0, 10), start);
  EXPECT_GT(std::abs(change[2]), 1e-3);
  EXPECT_GT(std::abs(change[3]), 1e-3);
  for (const int fixed : {0, 1, 4, 5}) EXPECT_NEAR(change[fixed], 0.0, 1e-9) << fixed;
}

TEST(FeatureProblem, OnePlaneLeavesThreeDirectionsToTheGuess) {
  const Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  const FeatureMatches matches = ExactMatches(0, 100, &normal);
  int removed = 0;
  const MotionSubspace kept = RemoveDegenerate(Linearize(matches, kTruth, 1.0),
                                               {Matrix6d::Identity(), 10.0}, 1e-3, &removed);
  EXPECT_EQ(removed, 3);
  Vector6d offset;
  offset << 0.02, -0.01, 0.03, 0.1, -0.05, 0.02;
  const SE3 start = Plus(kTruth, offset);
  const SE3 found = MinimizeDistances(matches, start, kept, 1.0, 20);
  EXPECT_NEAR(found.translation.x(), start.translation.x(), 1e-9);
  EXPECT_NEAR(found.translation.y(), start.translation.y(), 1e-9);
  EXPECT_LT(Linearize(matches, found, 1.0).cost, 1e-8);

  RemoveDegenerate(Linearize(ExactMatches(50, 50), kTruth, 1.0), {Matrix6d::Identity(), 10.0}, 1e-3,
                   &removed);
  EXPECT_EQ(removed, 0);
}

TEST(FeatureProblem, ScaleIsThatOfMostDistances) {
  Random random(9);
  FeatureMatches matches = ExactMatches(0, 500);
  for (FeaturePlane& plane : matches.planes) {
    plane.point += random.Gaussian(0.0, 0.05) * plane.normal;
  }
  for (size_t i = 0; i < 50; ++i) matches.planes[i].point += 10.0 * matches.planes[i].normal;
  EXPECT_NEAR(RobustScale(matches, kTruth, 0.01), 0.055, 0.01);
  EXPECT_EQ(RobustScale(matches, kTruth, 0.2), 0.2);
  EXPECT_EQ(RobustScale(FeatureMatches(), kTruth, 0.3), 0.3);
}

TEST(FeatureProblem, PointsWithoutMatchesAreAFault) {
  FeatureMatches matches = ExactMatches(3, 3);
  matches.lines.pop_back();
  EXPECT_THROW(Linearize(matches, kTruth, 1.0), CheckError);
}

}  // namespace
}  // namespace regolith
