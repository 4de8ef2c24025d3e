// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/loop_verifier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "regolith/backend/polar_descriptor.h"
#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

using HeightAt = std::function<double(double, double)>;

double Mounds(double x, double y) {
  return 0.3 * std::sin(0.31 * x + 0.5) * std::cos(0.23 * y) + 0.2 * std::sin(0.57 * y + 0.11 * x) +
         0.15 * std::cos(0.83 * x - 0.41 * y);
}

/// Points of the ground within 15 m, seen from 1.2 m above it, in the frame of the body.
std::vector<Eigen::Vector3d> Seen(const HeightAt& height, const SE3& T_world_body, uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector3d> points;
  const SE3 T_body_world = T_world_body.Inverse();
  for (int i = 0; i < 6000; ++i) {
    const double range = 15.0 * std::sqrt(random.Uniform());
    const double angle = random.Uniform(-3.1416, 3.1416);
    const double x = T_world_body.translation.x() + range * std::cos(angle);
    const double y = T_world_body.translation.y() + range * std::sin(angle);
    points.push_back(T_body_world * Eigen::Vector3d(x, y, height(x, y) + random.Gaussian(0, 0.01)));
  }
  return points;
}

SE3 Stand(const HeightAt& height, double x, double y, double yaw) {
  return {ExpSo3({0.02, -0.03, 0.0}) * ExpSo3({0.0, 0.0, yaw}), {x, y, height(x, y) + 1.2}};
}

LoopVerdict Verify(const HeightAt& height, const SE3& T_world_target, const SE3& T_world_query,
                   const SE3& T_target_query) {
  ThreadPool threads(2);
  const LoopVerifier verifier(LoopVerifierOptions(), &threads);
  LoopGuess guess;
  guess.T_target_query = T_target_query;
  return verifier.Verify(Seen(height, T_world_query, 1), Seen(height, T_world_target, 2), guess,
                         T_world_target.rotation);
}

TEST(LoopVerifier, FindsTheWayBetweenTwoPlacesThatFaceEachOther) {
  const SE3 target = Stand(Mounds, 0.0, 0.0, 0.3);
  const SE3 query = Stand(Mounds, 1.0, 0.7, 3.4);
  const SE3 truth = target.Inverse() * query;
  // The guess is off by 2 m and 4°.
  SE3 guess = truth;
  guess.rotation = truth.rotation * ExpSo3({0.0, 0.0, 0.07});
  guess.translation += Eigen::Vector3d(1.6, -1.3, 0.8);
  const LoopVerdict verdict = Verify(Mounds, target, query, guess);
  ASSERT_EQ(verdict.outcome, LoopOutcome::kAccepted) << LoopOutcomeName(verdict.outcome);
  const Vector6d error = LogSe3(truth.Inverse() * verdict.T_target_query.T_a_b);
  EXPECT_LT(error.head<3>().norm(), 3e-3);
  EXPECT_LT(error.tail<3>().norm(), 0.02);
  EXPECT_LT(SquaredDistance(verdict.T_target_query, {truth, Matrix6d::Zero()}), 20.0);
}

TEST(LoopVerifier, AnotherPlaceIsRefused) {
  const SE3 target = Stand(Mounds, 0.0, 0.0, 0.3);
  for (int i = 0; i < 10; ++i) {
    const SE3 query = Stand(Mounds, 20.0 + 3.0 * i, 9.0 * (i % 3), 0.2 * i);
    const SE3 guess(ExpSo3({0.0, 0.0, 0.2 * i - 0.3}), Eigen::Vector3d::Zero());
    EXPECT_NE(Verify(Mounds, target, query, guess).outcome, LoopOutcome::kAccepted) << i;
  }
}

TEST(LoopVerifier, GroundThatRepeatsIsAmbiguous) {
  const HeightAt ripples = [](double x, double y) {
    return 0.2 * std::sin(2.0 * 3.14159265 * x / 3.0) * std::sin(2.0 * 3.14159265 * y / 3.0);
  };
  const SE3 place = Stand(ripples, 0.0, 0.0, 0.0);
  EXPECT_EQ(Verify(ripples, place, place, SE3()).outcome, LoopOutcome::kAmbiguous);
}

TEST(LoopVerifier, APlaneConfirmsNothing) {
  const HeightAt plane = [](double x, double y) { return 0.05 * x - 0.02 * y; };
  const SE3 place = Stand(plane, 0.0, 0.0, 0.0);
  EXPECT_NE(Verify(plane, place, place, SE3()).outcome, LoopOutcome::kAccepted);
}

TEST(LoopVerifier, AFurrowLeavesADirectionOpen) {
  const HeightAt furrow = [](double x, double) { return 0.5 * std::exp(-0.1 * x * x); };
  const SE3 place = Stand(furrow, 0.0, 0.0, 0.0);
  EXPECT_NE(Verify(furrow, place, place, SE3()).outcome, LoopOutcome::kAccepted);
}

TEST(LoopVerifier, TooLittleGroundInCommonIsNoLoop) {
  ThreadPool threads(1);
  const LoopVerifier verifier(LoopVerifierOptions(), &threads);
  const SE3 place = Stand(Mounds, 0.0, 0.0, 0.0);
  const std::vector<Eigen::Vector3d> points = Seen(Mounds, place, 1);
  EXPECT_EQ(verifier.Verify({}, points, LoopGuess(), place.rotation).outcome,
            LoopOutcome::kTooLittleOverlap);
  LoopGuess far;
  far.T_target_query.translation = {28.0, 0.0, 0.0};
  EXPECT_EQ(verifier.Verify(points, points, far, place.rotation).outcome,
            LoopOutcome::kTooLittleOverlap);
}

TEST(PolarDescriptor, IsTheSameWhateverWayTheRoverFaces) {
  const ReliefMatchOptions options;
  const auto describe = [&](double x, double y, double yaw) {
    std::vector<Eigen::Vector3d> points = Seen(Mounds, Stand(Mounds, x, y, yaw), 3);
    const Eigen::Quaterniond level = ExpSo3({0.02, -0.03, 0.0});
    // Turned with the rover: only tilt is taken off.
    for (Eigen::Vector3d& point : points) {
      point = ExpSo3({0.0, 0.0, -yaw}) * level * ExpSo3({0.0, 0.0, yaw}) * point;
    }
    return DescribeRelief(ReliefImage(points, options).cells(), options.radius);
  };
  const PolarDescriptor place = describe(0.0, 0.0, 0.0);
  const double turned = PolarDistance(place, describe(0.0, 0.0, 2.2));
  EXPECT_LT(turned, 0.25);
  EXPECT_LT(PolarDistance(place, describe(0.5, 0.3, 4.0)), 0.45);
  for (int i = 0; i < 6; ++i) {
    EXPECT_GT(PolarDistance(place, describe(15.0 + 7.0 * i, 11.0, 0.0)), 2.0 * turned) << i;
  }
}

}  // namespace
}  // namespace regolith
