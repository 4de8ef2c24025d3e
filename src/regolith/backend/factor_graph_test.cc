// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/factor_graph.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"
#include "regolith/imu/preintegration.h"

namespace regolith {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kLap = 60;  // keyframes

SE3 Truth(int i) {
  const double angle = 2.0 * kPi * i / kLap;
  return {ExpSo3({0.0, 0.0, angle}),
          {10.0 * std::sin(angle), 10.0 * (1.0 - std::cos(angle)), 0.1 * std::sin(3 * angle)}};
}

Matrix6d Covariance(double rotation_sigma, double position_sigma) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma),
      Eigen::Vector3d::Constant(position_sigma * position_sigma);
  return variances.asDiagonal();
}

UncertainPose Measured(const SE3& motion, const Matrix6d& covariance, Random* random) {
  Vector6d error;
  for (int i = 0; i < 6; ++i) error[i] = random->Gaussian() * std::sqrt(covariance(i, i));
  return {motion * ExpSe3(error), covariance};
}

/// Laps on one circle; each keyframe from the second lap on sees the one of a lap before.
struct Laps {
  FactorGraph graph{FactorGraphOptions()};
  std::vector<EdgeId> loops;  ///< of the keyframes from kLap on

  explicit Laps(int count, uint64_t seed, bool merge = false) {
    Random random(seed);
    const Matrix6d step = Covariance(0.003, 0.02);
    const Matrix6d seen = Covariance(0.002, 0.02);
    graph.AddNode(Truth(0));
    graph.Hold(0);
    for (int i = 1; i < count; ++i) {
      const UncertainPose motion = Measured(Truth(i - 1).Inverse() * Truth(i), step, &random);
      const auto last = static_cast<NodeId>(i - 1);
      const NodeId node = graph.AddNode(graph.pose(last) * motion.T_a_b);
      graph.AddEdge({last, node, motion, false});
      if (i < kLap) continue;
      const auto old = static_cast<NodeId>(i - kLap);
      loops.push_back(graph.AddEdge(
          {old, node, Measured(Truth(i - kLap).Inverse() * Truth(i), seen, &random), true}));
      if (i % 10 == 0) graph.Solve();
      const int late = i - 5;
      if (merge && late >= kLap) {
        graph.Merge(static_cast<NodeId>(late), loops[static_cast<size_t>(late - kLap)]);
      }
    }
    graph.Solve();
  }

  double Error() const {
    double sum = 0.0;
    for (NodeId i = 0; i < graph.node_count(); ++i) {
      sum += (graph.pose(i).translation - Truth(static_cast<int>(i)).translation).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(graph.node_count()));
  }
};

TEST(FactorGraph, LoopsTakeTheDriftAway) {
  double with = 0.0;
  double without = 0.0;
  for (uint64_t seed = 0; seed < 5; ++seed) {
    with += Laps(2 * kLap, seed).Error();
    Laps open(2 * kLap, seed);
    for (const EdgeId loop : open.loops) open.graph.RemoveEdge(loop);
    open.graph.Solve();
    without += open.Error();
  }
  EXPECT_LT(with, 0.6 * without);
  EXPECT_LT(with / 5.0, 0.3);
}

TEST(FactorGraph, ASolveIsTheSameEachTime) {
  const Laps first(2 * kLap, 3);
  const Laps second(2 * kLap, 3);
  for (NodeId i = 0; i < first.graph.node_count(); ++i) {
    EXPECT_EQ(first.graph.pose(i).translation, second.graph.pose(i).translation);
  }
}

TEST(FactorGraph, OnExploredGroundItDoesNotGrow) {
  const Laps three(3 * kLap, 1, true);
  const Laps six(6 * kLap, 1, true);
  EXPECT_LE(six.graph.active_node_count(), three.graph.active_node_count() + 1);
  EXPECT_LE(six.graph.edge_count(), three.graph.edge_count() + 6);
  EXPECT_LT(six.graph.active_node_count(), kLap + 10U);
}

TEST(FactorGraph, MergedKeyframesAreAlmostAsExact) {
  double merged = 0.0;
  double full = 0.0;
  for (uint64_t seed = 0; seed < 5; ++seed) {
    merged += Laps(4 * kLap, seed, true).Error();
    full += Laps(4 * kLap, seed).Error();
  }
  EXPECT_LT(merged, 1.5 * full);
}

TEST(FactorGraph, AWrongLoopIsOutvotedByTheOdometry) {
  Laps laps(2 * kLap, 2);
  const double before = laps.Error();
  laps.graph.AddEdge({5, 35, {SE3(), Covariance(0.002, 0.02)}, true});
  laps.graph.Solve();
  EXPECT_LT(laps.Error(), before + 0.1);
}

TEST(FactorGraph, WhatAnEdgeDoesNotKnowIsLeftToTheOthers) {
  FactorGraph graph{FactorGraphOptions()};
  graph.AddNode(SE3());
  graph.Hold(0);
  graph.AddNode(SE3());
  // The lidar on a plane: nothing along x; its claim there is nonsense. The wheels say 1 m.
  Matrix6d information = Matrix6d::Identity() * 1e4;
  information(3, 3) = 0.0;
  const SE3 nonsense(Eigen::Quaterniond::Identity(), {9.0, 0.1, 0.2});
  graph.AddEdge({0, 1, {nonsense, CovarianceOf(information)}, false});
  graph.AddEdge({0, 1, {{Eigen::Quaterniond::Identity(), {1, 0, 0}}, Covariance(0.1, 0.1)}, true});
  graph.Solve();
  const Eigen::Vector3d position = graph.pose(1).translation;
  EXPECT_NEAR(position.x(), 1.0, 1e-3);
  EXPECT_NEAR(position.y(), 0.1, 2e-3);
  EXPECT_NEAR(position.z(), 0.2, 3e-3);
}

TEST(FactorGraph, FactorsOfOtherKindsJoinIn) {
  FactorGraph graph{FactorGraphOptions()};
  graph.AddNode(SE3(ExpSo3({0.1, 0.0, 0.0}), Eigen::Vector3d::Zero()));
  graph.AddNode(SE3(Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0}));
  graph.AddEdge(
      {0, 1, {{Eigen::Quaterniond::Identity(), {1, 0, 0}}, Covariance(0.01, 0.01)}, false});
  // Heights from elsewhere (z alone), the place of the first, and gravity.
  Matrix6d height = Matrix6d::Zero();
  height(5, 5) = 1e4;
  graph.AddFactor(MakePosePrior(0, SE3(Eigen::Quaterniond::Identity(), {0, 0, 5.0}), height));
  graph.AddFactor(MakePosePrior(1, SE3(Eigen::Quaterniond::Identity(), {0, 0, 5.1}), height));
  Matrix6d place = Matrix6d::Zero();
  place.diagonal() << 0.0, 0.0, 1e6, 1e6, 1e6, 0.0;
  graph.AddFactor(MakePosePrior(0, SE3(), place));
  graph.AddFactor(MakeGravityFactor(0, Eigen::Vector3d::UnitZ(), 0.5));
  graph.Solve();
  EXPECT_NEAR(graph.pose(1).translation.z() - graph.pose(0).translation.z(), 0.1, 1e-3);
  EXPECT_NEAR(graph.pose(0).translation.z(), 5.0, 1e-3);
  // The step of 0.1 m was one of pitch, and roll is gravity's.
  const Eigen::Vector3d up = graph.pose(0).rotation.conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::abs(up.x()), 0.1, 5e-3);
  EXPECT_NEAR(up.y(), 0.0, 1e-3);
}

TEST(FactorGraph, NodesThatHoldFactorsOfTheirOwnStay) {
  Laps laps(2 * kLap, 2);
  laps.graph.AddFactor(MakePosePrior(kLap + 3, Truth(3), Matrix6d::Identity()));
  laps.graph.AddFactor(MakeGravityFactor(kLap + 4, Eigen::Vector3d::UnitZ(), 0.1));
  EXPECT_FALSE(laps.graph.Merge(kLap + 3, laps.loops[3]));
  EXPECT_TRUE(laps.graph.Merge(kLap + 4, laps.loops[4]));
  EXPECT_TRUE(laps.graph.is_merged(kLap + 4));
  laps.graph.Solve();
  EXPECT_LT(laps.Error(), 0.3);
}

// Positions from elsewhere and an IMU with a bias: the graph finds velocity and bias.
TEST(FactorGraph, ImuFactorsBringVelocityAndBiases) {
  constexpr double kGravity = 1.62;
  const Eigen::Vector3d bias(0.03, -0.02, 0.01);
  FactorGraph graph{FactorGraphOptions()};
  constexpr int kNodes = 12;
  const auto place = [](double t) { return Eigen::Vector3d(0.5 * t, 0.2 * std::sin(t), 0.0); };
  std::vector<ImuSample> samples;
  for (int i = 0; i <= 100 * (kNodes - 1); ++i) {
    const double t = 0.01 * i;
    ImuSample sample;
    sample.time = FromSeconds(t);
    sample.specific_force = Eigen::Vector3d(0.0, -0.2 * std::sin(t), kGravity) + bias;
    samples.push_back(sample);
  }
  Matrix6d information = Matrix6d::Zero();
  information.diagonal() << 1e8, 1e8, 1e8, 1e4, 1e4, 1e4;
  for (int i = 0; i < kNodes; ++i) {
    NavState guess;
    guess.T_world_imu.translation = place(i);
    const NodeId node = graph.AddNode(guess);
    graph.AddFactor(MakePosePrior(node, guess.T_world_imu, information));
    if (i == 0) continue;
    ImuPreintegration imu(ImuNoise(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    imu.Integrate({samples.data() + 100 * (i - 1), 101});
    graph.AddFactor(MakeImuFactor(node - 1, node, imu, kGravity));
  }
  graph.Solve();
  const auto middle = graph.state(6);
  ASSERT_TRUE(middle.has_value());
  EXPECT_LT((middle->v_world_imu - Eigen::Vector3d(0.5, 0.2 * std::cos(6.0), 0.0)).norm(), 0.01);
  EXPECT_LT((middle->accelerometer_bias - bias).norm(), 0.004);
  EXPECT_FALSE(graph.Merge(6, graph.AddEdge({6, 5, {}, false})));
}

TEST(FactorGraph, EdgesOfMergedNodesGoOnToTheirAnchors) {
  Laps laps(2 * kLap, 2);
  const double before = laps.Error();
  ASSERT_TRUE(laps.graph.Merge(kLap + 4, laps.loops[4]));
  const Matrix6d covariance = Covariance(0.002, 0.02);
  const SE3 truth = Truth(10).Inverse() * Truth(kLap + 4);
  laps.graph.AddEdge({10, kLap + 4, {truth, covariance}, true});
  laps.graph.AddEdge({4, kLap + 4, {SE3(), covariance}, true});  // one node now
  laps.graph.Solve();
  EXPECT_LT(laps.Error(), before + 0.05);
  EXPECT_LT((laps.graph.pose(kLap + 4).translation - Truth(4).translation).norm(), 0.3);
}

TEST(FactorGraph, EdgesToNowhereAreRefused) {
  FactorGraph graph{FactorGraphOptions()};
  graph.AddNode(SE3());
  EXPECT_THROW(graph.AddEdge({0, 1, {}, false}), CheckError);
  EXPECT_THROW(graph.AddEdge({0, 0, {}, false}), CheckError);
}

}  // namespace
}  // namespace regolith
