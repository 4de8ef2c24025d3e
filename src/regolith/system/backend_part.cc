// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/backend_part.h"

#include <utility>

namespace regolith {

BackendPart::BackendPart(const BackendOptions& options, ThreadPool* threads, size_t capacity)
    : backend_(options, threads), worker_(capacity) {}

void BackendPart::Add(KeyframeInput keyframe) {
  worker_.Post([this, keyframe = std::move(keyframe), number = worker_.posted()] {
    std::vector<StageTime> stages = backend_.Add(keyframe);
    const std::lock_guard lock(mutex_);
    stages_[number] = std::move(stages);
    T_map_odom_ = backend_.T_world_odom();
  });
}

std::vector<StageTime> BackendPart::TakeStages(size_t keyframe) {
  const std::lock_guard lock(mutex_);
  std::vector<StageTime> stages = std::move(stages_[keyframe]);
  stages_.erase(keyframe);
  return stages;
}

SE3 BackendPart::T_map_odom() const {
  const std::lock_guard lock(mutex_);
  return T_map_odom_;
}

}  // namespace regolith
