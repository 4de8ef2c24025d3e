// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/pose_graph.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "regolith/core/check.h"
#include "regolith/factors/graph_solver.h"
#include "regolith/factors/pose_manifold.h"
#include "regolith/factors/relative_pose_factor.h"

namespace regolith {
namespace {

constexpr int kMostIterations = 50;
// Standard deviations beyond which a robust edge's pull grows no more.
constexpr double kRobustWidth = 3.0;

Matrix6d SquareRootInformation(const PoseGraphEdge& edge) {
  Vector6d roots;
  roots.head<3>().setConstant(1.0 / edge.rotation_sigma);
  roots.tail<3>().setConstant(1.0 / edge.position_sigma);
  return roots.asDiagonal();
}

}  // namespace

std::vector<SE3> OptimizePoseGraph(Span<const SE3> guess, Span<const PoseGraphEdge> edges) {
  std::vector<PoseBlock> blocks;
  blocks.reserve(guess.size());
  for (const SE3& pose : guess) blocks.push_back(ToPoseBlock(pose));

  PoseManifold manifold;
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  for (PoseBlock& block : blocks) {
    problem.AddParameterBlock(block.data(), kPoseBlockSize, &manifold);
  }
  for (const PoseGraphEdge& edge : edges) {
    REGOLITH_CHECK(edge.from < guess.size() && edge.to < guess.size() && edge.from != edge.to,
                   "edge from ", edge.from, " to ", edge.to, " among ", guess.size(), " poses");
    problem.AddResidualBlock(new RelativePoseFactor(edge.T_from_to, SquareRootInformation(edge)),
                             edge.robust ? new ceres::CauchyLoss(kRobustWidth) : nullptr,
                             blocks[edge.from].data(), blocks[edge.to].data());
  }
  if (!blocks.empty()) problem.SetParameterBlockConstant(blocks.front().data());

  SolveGraph(kMostIterations, &problem);

  std::vector<SE3> poses;
  poses.reserve(blocks.size());
  for (const PoseBlock& block : blocks) poses.push_back(FromPoseBlock(block.data()));
  return poses;
}

}  // namespace regolith
