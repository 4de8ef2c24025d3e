// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "regolith/backend/backend.h"
#include "regolith/backend/visual_loops.h"
#include "regolith/core/serial_worker.h"
#include "regolith/system/place_observer.h"

namespace regolith {

/// The back end beside the odometries: it never holds them up but where it falls behind by several
/// keyframes, and what it finds does not go back to them.
class BackendPart {
 public:
  /// `capacity`: keyframes that may wait; 0: no thread of its own.
  BackendPart(const BackendOptions& options, ThreadPool* threads, size_t capacity);

  /// From now on loops are looked for by what the camera saw at keyframes, too. Before the first.
  void LookForLoops(const VisualPlacesOptions& options, std::unique_ptr<PlaceObserver> observer);

  void Add(KeyframeInput keyframe, std::optional<KeyframeSight> sight);
  /// Whether the keyframe of that number is worked off.
  bool HasDone(size_t keyframe) const { return worker_.done() > keyframe; }
  /// What that took, once.
  std::vector<StageTime> TakeStages(size_t keyframe);
  /// T_map_odom as the newest keyframe that is worked off has it.
  SE3 T_map_odom() const;

  void Settle() const { worker_.WaitFor(worker_.posted()); }
  void Stop() { worker_.Stop(); }
  void RethrowFailure() const { worker_.RethrowFailure(); }
  /// After Settle, until the next Add.
  const Backend& backend() const { return backend_; }

 private:
  std::vector<StageTime> AddSight(const KeyframeSight& sight, const SE3& T_odom_body);

  Backend backend_;
  std::unique_ptr<PlaceObserver> observer_;    ///< null where images propose no loops
  std::unique_ptr<VisualLoops> visual_loops_;  ///< likewise
  mutable std::mutex mutex_;
  std::map<size_t, std::vector<StageTime>> stages_;
  SE3 T_map_odom_;
  SerialWorker worker_;
};

}  // namespace regolith
