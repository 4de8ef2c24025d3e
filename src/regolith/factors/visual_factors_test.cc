// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "regolith/factors/reprojection_factor.h"
#include "regolith/factors/scalar_factor.h"
#include "regolith/factors/stereo_factor.h"
#include "regolith/factors/test_jacobians_internal.h"

namespace regolith {
namespace {

const SE3 kFirst(ExpSo3({0.3, -0.5, 1.2}), {2.0, -1.0, 0.3});
const SE3 kSecond(ExpSo3({0.35, -0.4, 1.1}), {2.4, -0.8, 0.35});
const SE3 kCamera(ExpSo3({-1.4, 0.1, -1.5}), {0.3, 0.06, 0.9});
const SE3 kRightCamera(ExpSo3({-1.38, 0.12, -1.5}), {0.3, -0.06, 0.9});

Eigen::VectorXd Scalar(double value) { return Eigen::VectorXd::Constant(1, value); }

FeatureSighting Sighting(const Eigen::Vector3d& ray) {
  FeatureSighting sighting;
  sighting.bearing = ray.normalized();
  sighting.bearing_rate = sighting.bearing.cross(Eigen::Vector3d(0.1, 0.3, -0.2));
  sighting.time_offset = 0.002;
  return sighting;
}

TEST(ReprojectionFactor, IsZeroForALandmarkSeenTwice) {
  const Eigen::Vector3d landmark_camera(0.7, 0.4, 3.0);
  const Eigen::Vector3d landmark_world = kFirst * (kCamera * landmark_camera);
  const FeatureSighting first = Sighting(landmark_camera);
  const FeatureSighting second = Sighting(kCamera.Inverse() * (kSecond.Inverse() * landmark_world));
  const ReprojectionFactor factor(first, second, 0.002);
  const std::vector<Eigen::VectorXd> values = {ToPoseBlock(kFirst), ToPoseBlock(kSecond),
                                               ToPoseBlock(kCamera),
                                               Scalar(1.0 / landmark_camera.norm()), Scalar(0.002)};
  EXPECT_LT(ResidualsOf(factor, values).norm(), 1e-9);
}

TEST(ReprojectionFactor, JacobiansAreThoseOfTheResiduals) {
  const ReprojectionFactor factor(Sighting({0.2, -0.1, 1.0}), Sighting({0.3, -0.15, 1.0}), 0.1);
  for (const double inverse_distance : {0.3, 0.0}) {
    ExpectJacobiansMatch(factor,
                         {ToPoseBlock(kFirst), ToPoseBlock(kSecond), ToPoseBlock(kCamera),
                          Scalar(inverse_distance), Scalar(0.01)},
                         1e-6);
  }
}

TEST(StereoFactor, IsZeroForTheDistanceOfALandmark) {
  const Eigen::Vector3d landmark_left(0.7, 0.4, 3.0);
  const Eigen::Vector3d landmark_right = kRightCamera.Inverse() * (kCamera * landmark_left);
  const StereoFactor factor(landmark_left.normalized(), landmark_right.normalized(), 0.002);
  const std::vector<Eigen::VectorXd> values = {ToPoseBlock(kCamera), ToPoseBlock(kRightCamera),
                                               Scalar(1.0 / landmark_left.norm())};
  EXPECT_LT(ResidualsOf(factor, values).norm(), 1e-9);
  ExpectJacobiansMatch(factor, values, 1e-6);
}

TEST(ScalarFactors, JacobiansAreThoseOfTheResiduals) {
  ExpectJacobiansMatch(ScalarFactor(0.3, 0.05), {Scalar(0.4)}, 1e-8);
  ExpectJacobiansMatch(ScalarWalkFactor(0.05), {Scalar(0.4), Scalar(0.2)}, 1e-8);
}

}  // namespace
}  // namespace regolith
