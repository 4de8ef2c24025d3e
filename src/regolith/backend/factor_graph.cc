// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/factor_graph.h"

#include <algorithm>
#include <utility>

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "regolith/core/check.h"
#include "regolith/factors/graph_solver.h"
#include "regolith/factors/gravity_tilt.h"
#include "regolith/factors/pose_manifold.h"
#include "regolith/factors/relative_pose_factor.h"

namespace regolith {
namespace {

Matrix6d SquareRootOfEdge(const UncertainPose& motion) {
  return SquareRootOf(InformationOf(ExpToPlusCovariance(motion.covariance, motion.T_a_b)));
}

/// The edge as seen from `node`: the motion from it to the other end.
UncertainPose MotionFrom(NodeId node, const RelativeEdge& edge) {
  return edge.from == node ? edge.motion : Inverse(edge.motion);
}

NodeId OtherEnd(NodeId node, const RelativeEdge& edge) {
  return edge.from == node ? edge.to : edge.from;
}

}  // namespace

/// The Ceres problem of a graph; blocks are added when a term first names them, in a fixed order.
class FactorGraph::Problem {
 public:
  explicit Problem(std::deque<Node>* nodes) : nodes_(nodes), problem_(Ownership()) {
    problem_.AddParameterBlock(gravity_tilt_.data(), kTiltBlockSize);
    problem_.SetParameterBlockConstant(gravity_tilt_.data());
  }

  void Add(const RelativeEdge& edge, double robust_width) {
    problem_.AddResidualBlock(
        new RelativePoseFactor(edge.motion.T_a_b, SquareRootOfEdge(edge.motion)),
        edge.robust ? new ceres::CauchyLoss(robust_width) : nullptr,
        Block({edge.from, BlockKind::kPose}), Block({edge.to, BlockKind::kPose}));
  }

  void Add(const GraphFactor& factor) {
    std::vector<double*> blocks;
    for (const BlockId& id : factor.blocks()) blocks.push_back(Block(id));
    problem_.AddResidualBlock(factor.NewCost(), factor.NewLoss(), blocks);
  }

  GraphSolution Solve(int max_iterations) {
    const ceres::Solver::Summary summary = SolveGraph(max_iterations, &problem_);
    return {static_cast<int>(summary.iterations.size()), summary.initial_cost, summary.final_cost};
  }

 private:
  static ceres::Problem::Options Ownership() {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  double* Block(const BlockId& id) {
    Node& node = (*nodes_)[id.node];
    REGOLITH_CHECK(!node.is_merged, "a factor of node ", id.node, ", which is merged");
    if (id.kind == BlockKind::kGravityTilt) return gravity_tilt_.data();
    if (id.kind == BlockKind::kMotion) {
      REGOLITH_CHECK(node.has_motion, "node ", id.node, " has no velocity and biases");
      return node.motion.data();
    }
    if (!problem_.HasParameterBlock(node.pose.data())) {
      problem_.AddParameterBlock(node.pose.data(), kPoseBlockSize, &manifold_);
      if (node.is_held) problem_.SetParameterBlockConstant(node.pose.data());
    }
    return node.pose.data();
  }

  PoseManifold manifold_;
  std::array<double, kTiltBlockSize> gravity_tilt_{};
  std::deque<Node>* nodes_;
  ceres::Problem problem_;
};

FactorGraph::FactorGraph(const FactorGraphOptions& options) : options_(options) { options.Check(); }
FactorGraph::~FactorGraph() = default;
FactorGraph::FactorGraph(FactorGraph&&) noexcept = default;

NodeId FactorGraph::AddNode(const SE3& T_world_body) {
  Node node;
  Eigen::Map<PoseBlock>(node.pose.data(), kPoseBlockSize) = ToPoseBlock(T_world_body);
  nodes_.push_back(node);
  return nodes_.size() - 1;
}

NodeId FactorGraph::AddNode(const NavState& state) {
  const NodeId id = AddNode(state.T_world_imu);
  Node& node = nodes_.back();
  node.has_motion = true;
  Eigen::Map<Eigen::Vector3d>(node.motion.data()) = state.v_world_imu;
  Eigen::Map<Eigen::Vector3d>(node.motion.data() + 3) = state.gyro_bias;
  Eigen::Map<Eigen::Vector3d>(node.motion.data() + 6) = state.accelerometer_bias;
  return id;
}

EdgeId FactorGraph::AddEdge(const RelativeEdge& edge) {
  REGOLITH_CHECK(edge.from < nodes_.size() && edge.to < nodes_.size() && edge.from != edge.to,
                 "edge from ", edge.from, " to ", edge.to, " among ", nodes_.size(), " nodes");
  RelativeEdge placed = edge;
  // An end that is merged stands at a fixed place from its anchor.
  if (nodes_[edge.from].is_merged) {
    placed.from = nodes_[edge.from].anchor;
    placed.motion = Compose({nodes_[edge.from].T_anchor_node, Matrix6d::Zero()}, placed.motion);
  }
  if (nodes_[edge.to].is_merged) {
    placed.to = nodes_[edge.to].anchor;
    placed.motion =
        Compose(placed.motion, {nodes_[edge.to].T_anchor_node.Inverse(), Matrix6d::Zero()});
  }
  edges_.emplace(next_edge_, placed);
  return next_edge_++;
}

void FactorGraph::RemoveEdge(EdgeId edge) { edges_.erase(edge); }

FactorId FactorGraph::AddFactor(std::unique_ptr<GraphFactor> factor) {
  factors_.emplace(next_factor_, std::move(factor));
  return next_factor_++;
}

void FactorGraph::RemoveFactor(FactorId factor) { factors_.erase(factor); }

void FactorGraph::Hold(NodeId node) { nodes_.at(node).is_held = true; }

GraphSolution FactorGraph::Solve() {
  if (edges_.empty() && factors_.empty()) return {};
  Problem problem(&nodes_);
  for (const auto& [id, edge] : edges_) {
    // Both ends may have been merged into one node.
    if (edge.from != edge.to) problem.Add(edge, options_.robust_width);
  }
  for (const auto& [id, factor] : factors_) problem.Add(*factor);
  return problem.Solve(options_.max_iterations);
}

bool FactorGraph::MayMerge(NodeId node) const {
  if (nodes_[node].is_held || nodes_[node].is_merged || nodes_[node].has_motion) return false;
  for (const auto& [id, factor] : factors_) {
    for (const BlockId& block : factor->blocks()) {
      if (block.node == node && !factor->GoesWithItsNode()) return false;
    }
  }
  return true;
}

std::vector<EdgeId> FactorGraph::EdgesOf(NodeId node) const {
  std::vector<EdgeId> found;
  for (const auto& [id, edge] : edges_) {
    if (edge.from == node || edge.to == node) found.push_back(id);
  }
  return found;
}

bool FactorGraph::Fused(const RelativeEdge& edge) {
  for (auto& [id, other] : edges_) {
    const bool is_same = other.from == edge.from && other.to == edge.to;
    const bool is_reverse = other.from == edge.to && other.to == edge.from;
    if (!(is_same || is_reverse) || other.robust != edge.robust) continue;
    other.motion = Fuse(other.motion, is_same ? edge.motion : Inverse(edge.motion));
    return true;
  }
  return false;
}

bool FactorGraph::Merge(NodeId node, EdgeId via) {
  const auto found = edges_.find(via);
  REGOLITH_CHECK(found != edges_.end(), "edge ", via);
  const RelativeEdge link = found->second;
  REGOLITH_CHECK(link.from == node || link.to == node, "edge ", via, " does not reach node ", node);
  if (!MayMerge(node)) return false;
  const NodeId anchor = OtherEnd(node, link);
  const UncertainPose T_node_anchor = MotionFrom(node, link);

  std::vector<std::pair<EdgeId, RelativeEdge>> moved;
  for (const EdgeId id : EdgesOf(node)) {
    if (id != via) moved.emplace_back(id, edges_.at(id));
    edges_.erase(id);
  }
  UncertainPose share = T_node_anchor;
  share.covariance *= static_cast<double>(std::max<size_t>(moved.size(), 1));
  for (const auto& [id, edge] : moved) {
    const RelativeEdge placed{OtherEnd(node, edge), anchor,
                              Compose(Inverse(MotionFrom(node, edge)), share),
                              edge.robust || link.robust};
    if (placed.from != anchor && !Fused(placed)) edges_.emplace(id, placed);
  }

  const SE3 T_anchor_node = pose(anchor).Inverse() * pose(node);
  Node& merged = nodes_[node];
  merged.is_merged = true;
  merged.anchor = anchor;
  merged.T_anchor_node = T_anchor_node;
  ++merged_count_;
  // What hangs on this node hangs on its anchor now.
  for (Node& other : nodes_) {
    if (!other.is_merged || other.anchor != node) continue;
    other.anchor = anchor;
    other.T_anchor_node = T_anchor_node * other.T_anchor_node;
  }
  for (auto factor = factors_.begin(); factor != factors_.end();) {
    const std::vector<BlockId> blocks = factor->second->blocks();
    const bool goes = std::any_of(blocks.begin(), blocks.end(),
                                  [&](const BlockId& block) { return block.node == node; });
    factor = goes ? factors_.erase(factor) : std::next(factor);
  }
  return true;
}

SE3 FactorGraph::pose(NodeId node) const {
  const Node& found = nodes_.at(node);
  if (found.is_merged) return pose(found.anchor) * found.T_anchor_node;
  return FromPoseBlock(found.pose.data());
}

std::optional<NavState> FactorGraph::state(NodeId node) const {
  const Node& found = nodes_.at(node);
  if (!found.has_motion) return std::nullopt;
  NavState state;
  state.T_world_imu = pose(node);
  state.v_world_imu = Eigen::Map<const Eigen::Vector3d>(found.motion.data());
  state.gyro_bias = Eigen::Map<const Eigen::Vector3d>(found.motion.data() + 3);
  state.accelerometer_bias = Eigen::Map<const Eigen::Vector3d>(found.motion.data() + 6);
  return state;
}

}  // namespace regolith
