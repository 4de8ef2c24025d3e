// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/loop_consistency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

Matrix6d Covariance(double rotation_sigma, double position_sigma) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma),
      Eigen::Vector3d::Constant(position_sigma * position_sigma);
  return variances.asDiagonal();
}

SE3 At(double x) { return {Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}}; }

/// Out for 100 m and back again, facing forward all the way, a keyframe a metre.
OdometryChain OutAndBack(double position_sigma) {
  OdometryChain chain;
  for (int i = 0; i <= 200; ++i) {
    chain.Append(At(i <= 100 ? i : 200 - i), Covariance(0.1 * position_sigma, position_sigma));
  }
  return chain;
}

LoopMeasurement Loop(size_t old_keyframe, size_t new_keyframe, const Eigen::Vector3d& wrong_by,
                     Random* random) {
  const double x_old = static_cast<double>(old_keyframe);
  const double x_new = 200.0 - static_cast<double>(new_keyframe);
  LoopMeasurement loop;
  loop.old_keyframe = old_keyframe;
  loop.new_keyframe = new_keyframe;
  loop.T_old_new.T_a_b = At(x_new - x_old);
  loop.T_old_new.T_a_b.translation +=
      wrong_by + Eigen::Vector3d(random->Gaussian(), random->Gaussian(), random->Gaussian()) * 0.02;
  loop.T_old_new.covariance = Covariance(2e-3, 0.02);
  return loop;
}

size_t Accepted(const LoopConsistency& loops) {
  return static_cast<size_t>(std::accumulate(loops.accepted().begin(), loops.accepted().end(), 0));
}

TEST(LoopConsistency, TrueLoopsCarryTheDayOverTwentyThatAgreeOnSomethingElse) {
  Random random(1);
  const OdometryChain odometry = OutAndBack(0.03);
  LoopConsistency loops{LoopConsistencyOptions()};
  for (size_t i = 0; i < 20; ++i) {
    loops.Add(Loop(60 + i, 140 - i, {2.0, 1.0, 0.0}, &random), odometry);
  }
  for (size_t i = 0; i < 30; ++i) {
    loops.Add(Loop(50 + i, 150 - i, Eigen::Vector3d::Zero(), &random), odometry);
  }
  EXPECT_EQ(Accepted(loops), 30U);
  EXPECT_EQ(std::accumulate(loops.accepted().begin(), loops.accepted().begin() + 20, 0), 0);
}

TEST(LoopConsistency, WhatOdometryCannotHaveDrivenIsRefused) {
  Random random(2);
  const OdometryChain odometry = OutAndBack(0.01);
  const LoopConsistency loops{LoopConsistencyOptions()};
  EXPECT_TRUE(loops.AgreesWithOdometry(Loop(10, 190, Eigen::Vector3d::Zero(), &random), odometry));
  EXPECT_FALSE(loops.AgreesWithOdometry(Loop(10, 190, {12.0, 0.0, 0.0}, &random), odometry));
}

TEST(LoopConsistency, OneLoopAloneWaitsForOthers) {
  Random random(3);
  const OdometryChain odometry = OutAndBack(0.1);
  LoopConsistency loops{LoopConsistencyOptions()};
  loops.Add(Loop(50, 150, Eigen::Vector3d::Zero(), &random), odometry);
  EXPECT_EQ(Accepted(loops), 0U);
  // The same place again says nothing new.
  loops.Add(Loop(50, 150, Eigen::Vector3d::Zero(), &random), odometry);
  loops.Add(Loop(50, 150, Eigen::Vector3d::Zero(), &random), odometry);
  EXPECT_EQ(Accepted(loops), 0U);
  loops.Add(Loop(51, 149, Eigen::Vector3d::Zero(), &random), odometry);
  loops.Add(Loop(52, 148, Eigen::Vector3d::Zero(), &random), odometry);
  EXPECT_EQ(Accepted(loops), 5U);
}

TEST(LoopConsistency, OldLoopsKeepWhatWasDecidedOfThem) {
  Random random(4);
  const OdometryChain odometry = OutAndBack(0.1);
  LoopConsistencyOptions options;
  options.max_loops = 10;
  LoopConsistency loops(options);
  for (size_t i = 0; i < 40; ++i) {
    loops.Add(Loop(50 + i, 150 - i, Eigen::Vector3d::Zero(), &random), odometry);
  }
  EXPECT_EQ(Accepted(loops), 40U);
}

TEST(OdometryChain, KnowsTheWayBetweenAnyTwo) {
  OdometryChain chain;
  SE3 pose;
  UncertainPose composed;
  for (int i = 0; i < 30; ++i) {
    const Matrix6d step = Covariance(1e-3 * (1 + i % 3), 0.01 * (1 + i % 2));
    const SE3 motion(ExpSo3({0.02, 0.01 * i, 0.1}), {0.9, 0.1, 0.05});
    pose = i == 0 ? SE3(ExpSo3({0.0, 0.0, 2.0}), {5.0, 4.0, 3.0}) : pose * motion;
    chain.Append(pose, step);
    if (i > 7) composed = Compose(composed, {motion, step});
  }
  const UncertainPose way = chain.Between(7, 29);
  EXPECT_LT(LogSe3(way.T_a_b.Inverse() * composed.T_a_b).norm(), 1e-9);
  EXPECT_LT((way.covariance - composed.covariance).norm(), 1e-9);
  const UncertainPose back = chain.Between(29, 7);
  EXPECT_LT((back.covariance - Inverse(composed).covariance).norm(), 1e-9);
}

TEST(OdometryChain, AStepHasWhatTheEarlierPoseHasNot) {
  const SE3 from(ExpSo3({0.0, 0.1, 1.0}), {50.0, -20.0, 1.0});
  const SE3 step(ExpSo3({0.0, 0.0, 0.1}), {1.0, 0.0, 0.0});
  const Matrix6d before = Covariance(2e-3, 0.5);
  const Matrix6d added = Covariance(1e-3, 0.05);
  const Matrix6d adjoint = AdjointSe3(step.Inverse());
  const Matrix6d after = adjoint * before * adjoint.transpose() + added;
  const SE3 to = from * step;
  const Matrix6d found = StepCovariance(from, ExpToPlusCovariance(before, from), to,
                                        ExpToPlusCovariance(after, to), 1e-6, 1e-6);
  EXPECT_LT((found - added).norm(), 1e-6);
  // An odometry that found its map again is surer than before: the step keeps its floor.
  const Matrix6d floor = StepCovariance(from, ExpToPlusCovariance(after, from), to,
                                        ExpToPlusCovariance(before, to), 1e-3, 0.01);
  EXPECT_NEAR(floor(0, 0), 1e-6, 1e-9);
}

}  // namespace
}  // namespace regolith
