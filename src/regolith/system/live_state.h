// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "regolith/lio/scan_odometry.h"
#include "regolith/sensor/imu_sample.h"

namespace regolith {

/// The state at the newest IMU sample, at its rate: what odometry knew a moment ago, moved on by
/// the samples since. A correction is not taken at once but over a few tenths of a second, so that
/// the pose never jumps (ROS REP 105, frame `odom`).
class LiveState {
 public:
  /// Samples in order of their times; others are left out.
  void AddImu(const ImuSample& sample);
  /// What odometry says of a time that lies a little behind.
  void Correct(const InertialState& corrected);

  /// Nothing before the first correction.
  std::optional<NavState> state() const;

 private:
  void MoveOn(const ImuSample& from, const ImuSample& to);

  std::deque<ImuSample> samples_;  ///< from the last correction on
  std::optional<InertialState> moved_;
  SE3 T_moved_shown_;  ///< what of the corrections is not taken yet
};

}  // namespace regolith
