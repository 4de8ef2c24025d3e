// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/visual_loops.h"

#include <algorithm>
#include <cstdint>

namespace regolith {

void VisualLoops::Add(PlaceView view, Backend* backend) {
  const size_t newest = backend->keyframes().size() - 1;
  if (view.descriptors.size() == 0) return;
  index_.Add(static_cast<int64_t>(newest), view.descriptors);
  unnamed_.emplace_back(newest, std::move(view));
  if (!index_.has_vocabulary()) return;
  for (; !unnamed_.empty(); unnamed_.pop_front()) {
    auto& [keyframe, waiting] = unnamed_.front();
    waiting.global = index_.Global(static_cast<int64_t>(keyframe));
    places_.Add(keyframe, std::move(waiting));
  }
  // Where the lidar is silent it cannot confirm anything.
  if (backend->HasLoopAtNewest() || backend->keyframes()[newest].points_body.empty()) return;
  const LoopSearchOptions& search = backend->options().search;
  std::vector<LoopCandidate> candidates = places_.Propose(EndOfOld(backend->keyframes(), search));
  candidates.resize(std::min(candidates.size(), static_cast<size_t>(search.max_candidates)));
  for (const LoopCandidate& candidate : candidates) {
    if (backend->TryLoop(candidate, newest)) return;
  }
}

}  // namespace regolith
