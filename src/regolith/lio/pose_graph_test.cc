// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/pose_graph.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr int kPoses = 40;

/// Around a circle of radius 10 m, the last pose where the first is.
SE3 Truth(int i) {
  const double angle = 2.0 * 3.14159265358979 * i / (kPoses - 1);
  return {ExpSo3({0.0, 0.0, angle}), {10.0 * std::sin(angle), 10.0 * (1.0 - std::cos(angle)), 0.0}};
}

struct Drive {
  std::vector<SE3> poses;
  std::vector<PoseGraphEdge> edges;
};

/// Each step is measured too long and turns a little too far.
Drive DriftingDrive() {
  Drive drive;
  drive.poses.push_back(SE3());
  for (int i = 1; i < kPoses; ++i) {
    PoseGraphEdge edge;
    edge.from = static_cast<size_t>(i - 1);
    edge.to = static_cast<size_t>(i);
    edge.T_from_to = Truth(i - 1).Inverse() * Truth(i);
    edge.T_from_to.translation *= 1.01;
    edge.T_from_to.rotation = edge.T_from_to.rotation * ExpSo3({0.0, 0.0, 0.004});
    drive.edges.push_back(edge);
    drive.poses.push_back(drive.poses.back() * edge.T_from_to);
  }
  return drive;
}

PoseGraphEdge Loop(size_t from, size_t to, const SE3& T_from_to) {
  PoseGraphEdge loop;
  loop.from = from;
  loop.to = to;
  loop.T_from_to = T_from_to;
  loop.rotation_sigma = 0.001;
  loop.position_sigma = 0.01;
  loop.robust = true;
  return loop;
}

double MeanError(const std::vector<SE3>& poses) {
  double sum = 0.0;
  for (int i = 0; i < kPoses; ++i) {
    sum += (poses[static_cast<size_t>(i)].translation - Truth(i).translation).norm();
  }
  return sum / kPoses;
}

TEST(PoseGraph, ALoopSharesOutTheDrift) {
  Drive drive = DriftingDrive();
  const double before = MeanError(drive.poses);
  ASSERT_GT(before, 0.5);
  drive.edges.push_back(Loop(0, kPoses - 1, SE3()));
  const auto poses = OptimizePoseGraph(drive.poses, drive.edges);
  EXPECT_EQ(poses.front().translation, Eigen::Vector3d::Zero());
  EXPECT_LT(poses.back().translation.norm(), 0.05);
  EXPECT_LT(MeanError(poses), 0.3 * before);
}

TEST(PoseGraph, WithoutLoopsNothingMoves) {
  const Drive drive = DriftingDrive();
  const auto poses = OptimizePoseGraph(drive.poses, drive.edges);
  for (size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LT(Minus(poses[i], drive.poses[i]).norm(), 1e-9);
  }
}

TEST(PoseGraph, AWrongLoopAmongRightOnesPullsLittle) {
  Drive drive = DriftingDrive();
  for (const size_t i : {0U, 1U, 2U}) {
    const size_t last = kPoses - 1 - i;
    drive.edges.push_back(
        Loop(i, last, Truth(static_cast<int>(i)).Inverse() * Truth(static_cast<int>(last))));
  }
  const double without = MeanError(OptimizePoseGraph(drive.poses, drive.edges));
  drive.edges.push_back(Loop(3, kPoses / 2, SE3()));
  EXPECT_LT(MeanError(OptimizePoseGraph(drive.poses, drive.edges)), without + 0.1);
}

TEST(PoseGraph, EdgesToNowhereAreAFault) {
  const Drive drive = DriftingDrive();
  const std::vector<PoseGraphEdge> edges = {Loop(0, kPoses, SE3())};
  EXPECT_THROW(OptimizePoseGraph(drive.poses, edges), CheckError);
}

}  // namespace
}  // namespace regolith
