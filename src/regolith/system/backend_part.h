// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <mutex>
#include <vector>

#include "regolith/backend/backend.h"
#include "regolith/core/serial_worker.h"

namespace regolith {

/// The back end beside the odometries: it never holds them up but where it falls behind by several
/// keyframes, and what it finds does not go back to them.
class BackendPart {
 public:
  /// `capacity`: keyframes that may wait; 0: no thread of its own.
  BackendPart(const BackendOptions& options, ThreadPool* threads, size_t capacity);

  void Add(KeyframeInput keyframe);
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
  Backend backend_;
  mutable std::mutex mutex_;
  std::map<size_t, std::vector<StageTime>> stages_;
  SE3 T_map_odom_;
  SerialWorker worker_;
};

}  // namespace regolith
