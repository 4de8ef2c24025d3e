// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "regolith/backend/keyframe_store.h"
#include "regolith/backend/loop_verifier.h"

namespace regolith {

/// A proposal that the newest keyframe saw an old one's ground.
struct LoopCandidate {
  size_t old_keyframe = 0;
  LoopGuess guess;  ///< target: the old one
  double cost = 0.0;
};

/// Proposes old keyframes near the newest one, as far as is known where both are: the nearer and
/// the more like it in shape, the better.
class LoopDetector {
 public:
  explicit LoopDetector(const LoopSearchOptions& options) : options_(options) {}

  /// `last_loop`: the newest keyframe that a loop placed, if any: the doubt grows from there.
  std::vector<LoopCandidate> Propose(const KeyframeStore& keyframes, const FactorGraph& graph,
                                     const OdometryChain& odometry, double odometry_inflation,
                                     std::optional<size_t> last_loop) const;

 private:
  LoopSearchOptions options_;
};

}  // namespace regolith
