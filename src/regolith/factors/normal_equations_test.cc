// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/factors/normal_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "regolith/factors/relative_pose_factor.h"
#include "regolith/factors/reprojection_factor.h"
#include "regolith/factors/scalar_factor.h"
#include "regolith/factors/test_jacobians_internal.h"

namespace regolith {
namespace {

const PoseBlock kFirst = ToPoseBlock(SE3(ExpSo3({0.3, -0.5, 1.2}), {2.0, -1.0, 0.3}));
const PoseBlock kSecond = ToPoseBlock(SE3(ExpSo3({0.35, -0.4, 1.1}), {2.4, -0.8, 0.35}));
const PoseBlock kThird = ToPoseBlock(SE3(ExpSo3({0.4, -0.3, 1.0}), {2.8, -0.7, 0.3}));

TEST(LinearPriorFactor, JacobiansAreThoseOfTheResiduals) {
  PoseBlock pose = kFirst;
  Eigen::VectorXd scalar = Eigen::VectorXd::Constant(1, 0.3);
  LinearPrior prior;
  prior.blocks = {{pose.data(), kSecond}, {scalar.data(), Eigen::VectorXd::Constant(1, 0.1)}};
  prior.jacobian = Eigen::MatrixXd::Random(5, 7);
  prior.residual = Eigen::VectorXd::Random(5);
  ExpectJacobiansMatch(LinearPriorFactor(prior), {pose, scalar}, 1e-6);
}

/// Two measured steps between three poses, the first of which is known well.
class ThreePoses : public ::testing::Test {
 protected:
  PoseBlock first_ = kFirst;
  PoseBlock second_ = kSecond;
  PoseBlock third_ = kThird;
  RelativePoseFactor step_{SE3(ExpSo3({0.1, 0.0, 0.1}), {0.4, 0.1, 0.0}),
                           10.0 * Matrix6d::Identity()};

  std::vector<LinearisedBlock> Blocks() {
    return {{first_.data(), first_}, {second_.data(), second_}, {third_.data(), third_}};
  }
};

TEST_F(ThreePoses, APriorFromGivenUpPosesHasTheInformationOfTheWhole) {
  LinearPrior start;
  start.blocks = {{first_.data(), kFirst}};
  start.jacobian = 100.0 * Eigen::MatrixXd::Identity(6, 6);
  start.residual = Eigen::VectorXd::Constant(6, 0.1);
  NormalEquations whole(Blocks());
  whole.Add(LinearPriorFactor(start), nullptr, {first_.data()});
  whole.Add(step_, nullptr, {first_.data(), second_.data()});
  const LinearPrior prior = whole.Marginalise(1);
  ASSERT_EQ(prior.blocks.size(), 2U);
  // The third pose is not in any residual so far: no information may appear for it.
  EXPECT_EQ(prior.jacobian.rows(), 6);
  EXPECT_LT(prior.jacobian.rightCols<6>().norm(), 1e-9);

  whole.Add(step_, nullptr, {second_.data(), third_.data()});
  NormalEquations rest({{second_.data(), second_}, {third_.data(), third_}});
  rest.Add(LinearPriorFactor(prior), nullptr, {second_.data(), third_.data()});
  rest.Add(step_, nullptr, {second_.data(), third_.data()});
  const Eigen::MatrixXd expected = whole.Covariance(1);
  EXPECT_LT((rest.Covariance(0) - expected).norm(), 1e-6 * expected.norm());
}

TEST_F(ThreePoses, WhatCannotBeObservedStaysUnknown) {
  // Steps alone do not say where the chain lies, wherever the values have moved meanwhile.
  NormalEquations equations(Blocks());
  equations.Add(step_, nullptr, {first_.data(), second_.data()});
  equations.Add(step_, nullptr, {second_.data(), third_.data()});
  LinearPrior prior = equations.Marginalise(1);
  EXPECT_EQ(prior.jacobian.rows(), 6);
  third_ = ToPoseBlock(Plus(FromPoseBlock(third_.data()), 0.05 * Vector6d::Ones()));
  NormalEquations later(WithPriorPoints({{second_.data(), 7}, {third_.data(), 7}}, prior));
  later.Add(LinearPriorFactor(prior), nullptr, {second_.data(), third_.data()});
  later.Add(step_, nullptr, {second_.data(), third_.data()});
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(later.information()).eigenvalues();
  EXPECT_LT(eigenvalues.head<6>().cwiseAbs().maxCoeff(), 1e-9 * eigenvalues.maxCoeff());
}

TEST_F(ThreePoses, ALandmarkIsEliminatedAsADenseSolveWould) {
  PoseBlock camera = ToPoseBlock(SE3());
  double inverse_distance = 0.25;
  double offset = 0.0;
  FeatureSighting sighting;
  sighting.bearing = Eigen::Vector3d(0.1, 0.2, 1.0).normalized();
  const ReprojectionFactor seen(sighting, sighting, 0.01);
  const ScalarFactor measured(0.3, 0.1);
  NormalEquations eliminated(Blocks());
  eliminated.BeginLandmark(&inverse_distance);
  for (double* pose : {second_.data(), third_.data()}) {
    eliminated.Add(seen, nullptr, {first_.data(), pose, camera.data(), &inverse_distance, &offset});
  }
  eliminated.Add(measured, nullptr, {&inverse_distance});
  eliminated.EndLandmark();

  std::vector<LinearisedBlock> blocks = Blocks();
  blocks.insert(blocks.begin(), {&inverse_distance, Eigen::VectorXd::Constant(1, 0.25)});
  NormalEquations dense(blocks);
  for (double* pose : {second_.data(), third_.data()}) {
    dense.Add(seen, nullptr, {first_.data(), pose, camera.data(), &inverse_distance, &offset});
  }
  dense.Add(measured, nullptr, {&inverse_distance});
  const Eigen::MatrixXd h = dense.information();
  const Eigen::MatrixXd schur =
      h.bottomRightCorner(18, 18) - h.bottomLeftCorner(18, 1) * h.topRightCorner(1, 18) / h(0, 0);
  EXPECT_LT((eliminated.information() - schur).norm(), 1e-9 * schur.norm());
}

}  // namespace
}  // namespace regolith
