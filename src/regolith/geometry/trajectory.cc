// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/geometry/trajectory.h"

#include <algorithm>
#include <utility>

#include "regolith/core/check.h"

namespace regolith {

Trajectory::Trajectory(std::vector<StampedPose> poses) : poses_(std::move(poses)) {
  for (size_t i = 1; i < poses_.size(); ++i) {
    REGOLITH_CHECK(poses_[i - 1].time < poses_[i].time, "pose ", i, " at ", poses_[i].time,
                   " ns follows ", poses_[i - 1].time, " ns");
  }
}

void Trajectory::Append(const StampedPose& pose) {
  REGOLITH_CHECK(poses_.empty() || poses_.back().time < pose.time, "pose at ", pose.time,
                 " ns follows ", poses_.back().time, " ns");
  poses_.push_back(pose);
}

std::optional<SE3> Trajectory::At(TimeNs time) const {
  if (poses_.empty() || time < poses_.front().time || time > poses_.back().time) {
    return std::nullopt;
  }
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), time,
                       [](const StampedPose& pose, TimeNs value) { return pose.time < value; });
  if (after->time == time) return after->T_world_body;
  const auto before = after - 1;
  const double fraction =
      SecondsBetween(before->time, time) / SecondsBetween(before->time, after->time);
  return Interpolate(before->T_world_body, after->T_world_body, fraction);
}

double Trajectory::Length() const {
  double length = 0.0;
  for (size_t i = 1; i < poses_.size(); ++i) {
    length += (poses_[i].T_world_body.translation - poses_[i - 1].T_world_body.translation).norm();
  }
  return length;
}

}  // namespace regolith
