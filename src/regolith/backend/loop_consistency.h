// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "regolith/backend/loop_consistency_options.h"
#include "regolith/backend/odometry_chain.h"

namespace regolith {

/// A loop between two keyframes, each by its index in the odometry chain.
struct LoopMeasurement {
  size_t old_keyframe = 0;
  size_t new_keyframe = 0;
  UncertainPose T_old_new;
};

/// Says which loops belong together: the largest set that agrees pair by pair (Mangelson et al.
/// 2018). A pair agrees where the way around it (loop, odometry, loop back, odometry back) ends
/// where it began, as far as all of them are known. Of that set, those are accepted that others
/// confirm; a loop that contradicts the odometry never enters.
class LoopConsistency {
 public:
  explicit LoopConsistency(const LoopConsistencyOptions& options);

  /// Whether a loop is what odometry, with all it may be off by, could have driven.
  bool AgreesWithOdometry(const LoopMeasurement& loop, const OdometryChain& odometry) const;

  /// Adds a loop; `accepted()` may change for any of them.
  void Add(const LoopMeasurement& loop, const OdometryChain& odometry);

  /// In the order of Add.
  const std::vector<LoopMeasurement>& loops() const { return loops_; }
  const std::vector<uint8_t>& accepted() const { return accepted_; }

 private:
  struct Agreement {
    bool agrees = false;
    bool confirms = false;
  };
  UncertainPose Way(const OdometryChain& odometry, size_t from, size_t to) const;
  Agreement Compare(const LoopMeasurement& first, const LoopMeasurement& second,
                    const OdometryChain& odometry) const;
  std::vector<size_t> LargestSet() const;
  void Decide();

  LoopConsistencyOptions options_;
  std::vector<LoopMeasurement> loops_;
  std::vector<uint8_t> accepted_;
  /// Of the newest loops: row i is of loop first_ + i, with those before it.
  size_t first_ = 0;
  std::vector<std::vector<Agreement>> agreements_;
};

}  // namespace regolith
