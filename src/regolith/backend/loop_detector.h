// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "regolith/backend/keyframe_store.h"
#include "regolith/backend/loop_verifier.h"

namespace regolith {

/// What proposed a loop.
enum class LoopSource {
  kPosition,  ///< where both are known to be, and the shape of the ground
  kImages,    ///< what a camera saw
};
const char* LoopSourceName(LoopSource source);

/// A proposal that the newest keyframe saw an old one's ground.
struct LoopCandidate {
  LoopSource source = LoopSource::kPosition;
  size_t old_keyframe = 0;
  LoopGuess guess;  ///< target: the old one
  double cost = 0.0;
};

/// The keyframes before this one are old enough for loops with the newest.
size_t EndOfOld(const KeyframeStore& keyframes, const LoopSearchOptions& options);

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
