// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "regolith/backend/backend_options.h"
#include "regolith/geometry/so3.h"
#include "regolith/geometry/trajectory.h"

namespace regolith {

/// Says which poses of an odometry become keyframes: those far enough from the last one.
class KeyframeSelector {
 public:
  explicit KeyframeSelector(const KeyframeOptions& options) : options_(options) {}

  /// Where it is one, the next are measured from it. Times increase.
  bool Select(TimeNs time, const SE3& T_odom_body) {
    if (last_ && !IsFar(time, T_odom_body)) return false;
    last_ = StampedPose{time, T_odom_body};
    return true;
  }

 private:
  bool IsFar(TimeNs time, const SE3& T_odom_body) const {
    const SE3 moved = last_->T_world_body.Inverse() * T_odom_body;
    return moved.translation.norm() >= options_.distance ||
           LogSo3(moved.rotation).norm() >= options_.angle ||
           SecondsBetween(last_->time, time) >= options_.seconds;
  }

  KeyframeOptions options_;
  std::optional<StampedPose> last_;
};

}  // namespace regolith
