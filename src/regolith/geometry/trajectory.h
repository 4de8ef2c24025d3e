// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/core/time.h"
#include "regolith/geometry/se3.h"

namespace regolith {

struct StampedPose {
  TimeNs time = 0;
  SE3 T_world_body;
};

/// Poses at strictly increasing times.
class Trajectory {
 public:
  Trajectory() = default;
  /// Throws CheckError where times do not increase.
  explicit Trajectory(std::vector<StampedPose> poses);

  /// Throws CheckError where `pose` is not later than the last one.
  void Append(const StampedPose& pose);

  Span<const StampedPose> poses() const { return poses_; }
  bool empty() const { return poses_.empty(); }
  size_t size() const { return poses_.size(); }

  /// The pose at `time`, interpolated between its neighbours; nothing outside the first and last
  /// pose.
  std::optional<SE3> At(TimeNs time) const;

  /// Sum of the distances between consecutive poses, m.
  double Length() const;

 private:
  std::vector<StampedPose> poses_;
};

}  // namespace regolith
