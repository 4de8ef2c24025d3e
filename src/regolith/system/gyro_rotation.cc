// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/gyro_rotation.h"

#include <algorithm>

#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

// A rover turns at 1 rad/s at most: unseen for longer, it may be off by more than a search radius.
constexpr double kLongestGap = 0.05;  // s

Eigen::Vector3d RateAt(const ImuSample& from, const ImuSample& to, TimeNs time) {
  const double share = SecondsBetween(from.time, time) / SecondsBetween(from.time, to.time);
  return from.angular_velocity + share * (to.angular_velocity - from.angular_velocity);
}

}  // namespace

void GyroRotation::Add(const ImuSample& sample) {
  if (samples_.empty() || sample.time > samples_.back().time) samples_.push_back(sample);
}

std::optional<Eigen::Quaterniond> GyroRotation::Between(TimeNs start, TimeNs end) {
  while (samples_.size() > 1 && samples_[1].time <= start) samples_.pop_front();
  if (samples_.empty() || end < start) return std::nullopt;
  if (SecondsBetween(start, samples_.front().time) > kLongestGap ||
      SecondsBetween(samples_.back().time, end) > kLongestGap) {
    return std::nullopt;
  }
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  const auto turn = [&](const Eigen::Vector3d& rate, TimeNs from, TimeNs to) {
    rotation = rotation * ExpSo3((rate - gyro_bias_) * SecondsBetween(from, to));
  };
  // Before the first and after the last sample the nearest rate is the best guess.
  const TimeNs first = std::min(samples_.front().time, end);
  if (first > start) turn(samples_.front().angular_velocity, start, first);
  for (size_t i = 1; i < samples_.size() && samples_[i - 1].time < end; ++i) {
    const ImuSample& before = samples_[i - 1];
    const ImuSample& after = samples_[i];
    if (SecondsBetween(before.time, after.time) > kLongestGap) return std::nullopt;
    const TimeNs from = std::max(before.time, start);
    const TimeNs to = std::min(after.time, end);
    // Between samples the rate is taken as linear: its mean is that in the middle.
    if (to > from) turn(RateAt(before, after, from + (to - from) / 2), from, to);
  }
  const TimeNs last = std::max(samples_.back().time, start);
  if (end > last) turn(samples_.back().angular_velocity, last, end);
  return rotation;
}

}  // namespace regolith
