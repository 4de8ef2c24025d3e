// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/factors/point_projection_factor.h"

#include <gtest/gtest.h>

#include "regolith/factors/test_jacobians_internal.h"

namespace regolith {
namespace {

const RectifiedCamera kCamera{640, 480, 381.0, {318.0, 242.0}, 0.12};
const SE3 kPose(ExpSo3({0.3, -0.5, 1.2}), {2.0, -1.0, 0.3});
const Eigen::Vector3d kPointCamera(0.7, -0.4, 3.0);

TEST(PointProjectionFactor, IsZeroWhereThePointIsSeen) {
  const Eigen::Vector3d seen = kCamera.Project(kPointCamera);
  EXPECT_NEAR(seen.x() - seen.z(), 381.0 * 0.12 / 3.0, 1e-12);
  EXPECT_NEAR(kCamera.Depth(seen.x() - seen.z()), 3.0, 1e-12);
  EXPECT_LT((kCamera.PointAt(seen.head<2>(), 3.0) - kPointCamera).norm(), 1e-12);
  const std::vector<Eigen::VectorXd> values = {ToPoseBlock(kPose), kPose * kPointCamera};
  EXPECT_LT(ResidualsOf(StereoProjectionFactor(kCamera, seen, 0.5, 0.2), values).norm(), 1e-9);
  EXPECT_LT(ResidualsOf(MonoProjectionFactor(kCamera, seen, 0.5, 0.2), values).norm(), 1e-9);
}

TEST(PointProjectionFactor, AKeypointBesideItsPointSaysNothingOfTheDistance) {
  const std::vector<Eigen::VectorXd> values = {ToPoseBlock(kPose), kPose * kPointCamera};
  const Eigen::Vector3d beside =
      kCamera.Project(kPointCamera) + Eigen::Vector3d(1.0, 0.5, 1.0);  // in both eyes
  const Eigen::VectorXd residuals =
      ResidualsOf(StereoProjectionFactor(kCamera, beside, 0.5, 0.1), values);
  EXPECT_NEAR(residuals[0], -2.0, 1e-9);
  EXPECT_NEAR(residuals[1], -1.0, 1e-9);
  EXPECT_NEAR(residuals[2], 0.0, 1e-9);
  const Eigen::Vector3d nearer = kCamera.Project(kPointCamera) - Eigen::Vector3d(0.0, 0.0, 1.0);
  EXPECT_NEAR(ResidualsOf(StereoProjectionFactor(kCamera, nearer, 0.5, 0.1), values)[2], -10.0,
              1e-9);
}

TEST(PointProjectionFactor, JacobiansAreThoseOfTheResiduals) {
  const Eigen::Vector3d seen(401.0, 200.0, 387.0);
  const std::vector<Eigen::VectorXd> values = {ToPoseBlock(kPose), kPose * kPointCamera};
  ExpectJacobiansMatch(StereoProjectionFactor(kCamera, seen, 2.0, 0.3), values, 1e-6);
  ExpectJacobiansMatch(MonoProjectionFactor(kCamera, seen, 2.0, 0.3), values, 1e-6);
}

TEST(PointProjectionFactor, APointBehindTheCameraIsNotEvaluated) {
  const Eigen::VectorXd pose = ToPoseBlock(kPose);
  const Eigen::Vector3d point = kPose * Eigen::Vector3d(0.1, 0.1, -1.0);
  const double* blocks[] = {pose.data(), point.data()};
  double residuals[3];
  EXPECT_FALSE(
      StereoProjectionFactor(kCamera, {0, 0, 0}, 1.0, 1.0).Evaluate(blocks, residuals, nullptr));
}

}  // namespace
}  // namespace regolith
