// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "regolith/backend/factor_graph_options.h"
#include "regolith/backend/graph_factor.h"
#include "regolith/backend/uncertain_pose.h"
#include "regolith/geometry/nav_state.h"

namespace regolith {

/// A measured motion between two keyframes: by an odometry, or by a loop.
struct RelativeEdge {
  NodeId from = 0;
  NodeId to = 0;
  UncertainPose motion;  ///< T_from_to
  bool robust = false;   ///< it may be wrong: its pull is bounded
};

using EdgeId = size_t;
using FactorId = size_t;

struct GraphSolution {
  int iterations = 0;
  double initial_cost = 0.0;  ///< half the sum of the squared residuals
  double final_cost = 0.0;
};

/// Keyframes as nodes, what was measured of them as edges and factors. A solve is least squares by
/// Ceres on one thread, so it is the same on every run. Nodes on ground that was explored before
/// can be merged into the older ones, so that the graph grows with the ground, not with the drive
/// (after the reduced pose graph of Johannsson et al. 2013).
class FactorGraph {
 public:
  explicit FactorGraph(const FactorGraphOptions& options);
  ~FactorGraph();
  FactorGraph(FactorGraph&&) noexcept;

  NodeId AddNode(const SE3& T_world_body);
  /// With velocity and biases, for IMU factors.
  NodeId AddNode(const NavState& state);
  EdgeId AddEdge(const RelativeEdge& edge);
  void RemoveEdge(EdgeId edge);
  /// False where it was removed, or became one with another.
  bool HasEdge(EdgeId edge) const { return edges_.count(edge) > 0; }
  FactorId AddFactor(std::unique_ptr<GraphFactor> factor);
  void RemoveFactor(FactorId factor);
  /// The poses of held nodes do not move. Without a prior one has to be held.
  void Hold(NodeId node);

  /// Brings all poses into agreement, from where they are.
  GraphSolution Solve();

  /// Takes `node` out of the optimisation: from now on it stands at its present place from the
  /// node at the other end of `via`. Its other edges go on to that one, each with its share of the
  /// information of `via`, so that none counts twice; edges between the same two nodes become one,
  /// the older. False, and nothing is done, where the node has to stay: held, with a motion state,
  /// or with factors that do not go with it.
  bool Merge(NodeId node, EdgeId via);

  SE3 pose(NodeId node) const;
  /// Nothing for nodes without motion state.
  std::optional<NavState> state(NodeId node) const;
  size_t node_count() const { return nodes_.size(); }
  /// Nodes that a solve optimises, and edges between them.
  size_t active_node_count() const { return nodes_.size() - merged_count_; }
  size_t edge_count() const { return edges_.size(); }
  /// The node that a node was merged into; itself where it was not.
  NodeId standing(NodeId node) const {
    return nodes_.at(node).is_merged ? nodes_.at(node).anchor : node;
  }
  bool is_merged(NodeId node) const { return nodes_[node].is_merged; }

 private:
  struct Node {
    std::array<double, 7> pose{};    ///< PoseBlock
    std::array<double, 9> motion{};  ///< BlockKind::kMotion
    bool has_motion = false;
    bool is_held = false;
    bool is_merged = false;
    NodeId anchor = 0;  ///< of a merged node
    SE3 T_anchor_node;
  };
  class Problem;

  bool MayMerge(NodeId node) const;
  std::vector<EdgeId> EdgesOf(NodeId node) const;
  /// Whether the edge became one with another between the same nodes.
  bool Fused(const RelativeEdge& edge);

  FactorGraphOptions options_;
  std::deque<Node> nodes_;  ///< their blocks never move
  std::map<EdgeId, RelativeEdge> edges_;
  std::map<FactorId, std::unique_ptr<GraphFactor>> factors_;
  EdgeId next_edge_ = 0;
  FactorId next_factor_ = 0;
  size_t merged_count_ = 0;
};

}  // namespace regolith
