// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "regolith/backend/backend_options.h"
#include "regolith/backend/factor_graph.h"
#include "regolith/backend/keyframe_store.h"
#include "regolith/backend/loop_consistency.h"
#include "regolith/backend/loop_detector.h"
#include "regolith/backend/loop_verifier.h"
#include "regolith/core/stopwatch.h"
#include "regolith/geometry/trajectory.h"

namespace regolith {

/// What an odometry says of a keyframe.
struct KeyframeInput {
  TimeNs time = 0;
  SE3 T_odom_body;
  /// Of the pose in the odometry's frame, as Plus() perturbs it, with all its drift.
  Matrix6d covariance = Matrix6d::Zero();
  bool is_level = false;                     ///< the odometry knows where up is, its z axis
  std::vector<Eigen::Vector3d> points_body;  ///< m, of one scan without motion distortion
};

/// A loop that was proposed, and what became of it.
struct LoopRecord {
  size_t old_keyframe = 0;
  size_t new_keyframe = 0;
  LoopSource source = LoopSource::kPosition;
  LoopVerdict verdict;
};

/// The back end: keyframes of an odometry, their factor graph, and the loops that bring them into
/// agreement. The odometry itself is never changed: its frame `odom` is smooth, and the back end
/// says where that lies in the world (ROS REP 105).
class Backend {
 public:
  Backend(const BackendOptions& options, ThreadPool* threads);

  const BackendOptions& options() const { return options_; }

  /// Adds a keyframe, looks for loops at it, and brings the graph into agreement where one was
  /// accepted. Times increase.
  std::vector<StageTime> Add(const KeyframeInput& input);

  /// Tries a loop that was proposed from elsewhere, by vision for instance: it has to pass the same
  /// tests as the back end's own. Whether it did; it may still wait for others to confirm it. An
  /// old keyframe that is merged stands for the one that it was merged into.
  bool TryLoop(const LoopCandidate& candidate, size_t new_keyframe);
  /// Takes a loop that was measured and confirmed elsewhere: it still has to be what the odometry
  /// could have driven, and others have to support it before it is used.
  void AddLoop(const LoopMeasurement& loop);
  /// The odometry's poses as the back end has them now: each stands between its two keyframes.
  Trajectory Corrected(const Trajectory& odometry) const;
  /// T_world_odom at the newest keyframe.
  SE3 T_world_odom() const;

  /// Whether a loop of the newest keyframe has passed the tests.
  bool HasLoopAtNewest() const;
  const KeyframeStore& keyframes() const { return keyframes_; }
  SE3 T_world_body(size_t keyframe) const { return graph_.pose(keyframe); }
  /// All loops that were proposed, in their order.
  const std::vector<LoopRecord>& loops() const { return loops_; }
  size_t loops_accepted() const;
  size_t loops_rejected() const { return loops_.size() - loops_accepted(); }
  /// For factors of other kinds, and to see its size. A keyframe's node has its index.
  FactorGraph& graph() { return graph_; }
  const FactorGraph& graph() const { return graph_; }

 private:
  struct ActiveLoop {
    size_t record = 0;  ///< index in loops_
    std::optional<EdgeId> edge;
    bool confirms = false;   ///< what the graph has already
    bool is_merged = false;  ///< part of the graph for good
  };

  void AddNode(const KeyframeInput& input);
  bool FindLoops();
  bool Verify(const LoopCandidate& candidate, size_t new_keyframe);
  /// Records a loop; whether it takes part.
  bool Enter(LoopRecord record);
  /// Uses the loops that are accepted now, and brings the graph into agreement where that changed.
  void Update();
  bool Confirms(const LoopMeasurement& loop) const;
  SE3 Between(size_t from, size_t to) const {
    return graph_.pose(from).Inverse() * graph_.pose(to);
  }
  /// The loop has become part of the graph for good.
  static void Seal(ActiveLoop* loop);
  bool UseAcceptedLoops();
  void MergeExplored();

  BackendOptions options_;
  FactorGraph graph_;
  OdometryChain odometry_;
  KeyframeStore keyframes_;
  LoopDetector detector_;
  LoopVerifier verifier_;
  LoopConsistency consistency_;
  Matrix6d last_covariance_ = Matrix6d::Zero();
  std::vector<LoopRecord> loops_;
  std::vector<ActiveLoop> confirmed_;  ///< those that went into `consistency_`, in its order
  std::optional<size_t> last_loop_;    ///< newest keyframe with an accepted loop
};

}  // namespace regolith
