// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/backend_part.h"

#include <utility>

namespace regolith {

BackendPart::BackendPart(const BackendOptions& options, ThreadPool* threads, size_t capacity)
    : backend_(options, threads), worker_(capacity) {}

void BackendPart::LookForLoops(const VisualPlacesOptions& options,
                               std::unique_ptr<PlaceObserver> observer) {
  observer_ = std::move(observer);
  visual_loops_ = std::make_unique<VisualLoops>(options);
}

void BackendPart::Add(KeyframeInput keyframe, std::optional<KeyframeSight> sight) {
  worker_.Post(
      [this, keyframe = std::move(keyframe), sight = std::move(sight), number = worker_.posted()] {
        std::vector<StageTime> stages = backend_.Add(keyframe);
        if (sight && visual_loops_) {
          for (const StageTime& stage : AddSight(*sight, keyframe.T_odom_body)) {
            stages.push_back(stage);
          }
        }
        const std::lock_guard lock(mutex_);
        stages_[number] = std::move(stages);
        T_map_odom_ = backend_.T_world_odom();
      });
}

std::vector<StageTime> BackendPart::AddSight(const KeyframeSight& sight, const SE3& T_odom_body) {
  Stopwatch stopwatch;
  PlaceView view = observer_->Observe(sight, T_odom_body);
  stopwatch.Lap("place_view");
  visual_loops_->Add(std::move(view), &backend_);
  stopwatch.Lap("visual_loops");
  return stopwatch.stages();
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
