// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "regolith/core/thread_pool.h"
#include "regolith/core/time.h"
#include "regolith/lio/feature_map.h"
#include "regolith/lio/keyframe_graph_options.h"
#include "regolith/lio/pose_graph.h"

namespace regolith {

/// A scan that stands for those around it.
struct Keyframe {
  TimeNs time = 0;
  SE3 T_map_lidar;     ///< as corrected by loops
  FeatureCloud cloud;  ///< lidar
};

/// The keyframes of a drive, the motions between them and the loops that were found (Shan & Englot
/// 2018, section III-E): a new keyframe near an old one is matched by ICP with the features around
/// that one, and the graph of all poses is brought into agreement.
class KeyframeGraph {
 public:
  KeyframeGraph(const KeyframeGraphOptions& options, const FeatureMapOptions& map);

  const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  size_t loops_accepted() const { return loops_accepted_; }
  size_t loops_rejected() const { return loops_rejected_; }

  /// Whether a scan at this pose is far enough from the last keyframe to be one.
  bool IsNew(const SE3& T_map_lidar) const;
  void Add(Keyframe keyframe);

  /// Looks for a loop at the newest keyframe. True where one was found: all poses may have changed.
  bool CloseLoop(ThreadPool* threads);

 private:
  std::optional<size_t> FindOld() const;
  std::optional<SE3> MatchOld(size_t old, ThreadPool* threads) const;

  KeyframeGraphOptions options_;
  FeatureMapOptions map_;
  std::vector<Keyframe> keyframes_;
  std::vector<PoseGraphEdge> edges_;
  size_t last_attempt_ = 0;
  size_t loops_accepted_ = 0;
  size_t loops_rejected_ = 0;
};

}  // namespace regolith
