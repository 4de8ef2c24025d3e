// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/imu_quality.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr int kStuckSamples = 3;
/// A sensor in its middle range may repeat a value; at the end of it the value is large.
constexpr double kLeastRate = 0.5;        // rad/s
constexpr double kLeastForceShare = 1.3;  // of gravity

}  // namespace

bool ImuQuality::IsStuck(double value, double last, double least) const {
  return value == last && std::abs(value) > least;
}

void ImuQuality::Add(const ImuSample& sample) {
  if (has_last_) {
    const double step = SecondsBetween(last_.time, sample.time);
    if (step > max_gap_) {
      stretches_.push_back({last_.time, sample.time});
      ++gaps_;
      longest_gap_ = std::max(longest_gap_, step);
    }
    bool is_stuck = false;
    for (int axis = 0; axis < 3; ++axis) {
      is_stuck |= IsStuck(sample.angular_velocity[axis], last_.angular_velocity[axis], kLeastRate);
      is_stuck |= IsStuck(sample.specific_force[axis], last_.specific_force[axis],
                          kLeastForceShare * gravity_);
    }
    stuck_ = is_stuck ? stuck_ + 1 : 0;
    if (stuck_ == kStuckSamples) ++saturated_;
    if (stuck_ >= kStuckSamples) stretches_.push_back({last_.time, sample.time});
  }
  last_ = sample;
  has_last_ = true;
}

bool ImuQuality::IsDoubtful(TimeNs start, TimeNs end) const {
  return std::any_of(stretches_.begin(), stretches_.end(), [&](const Stretch& stretch) {
    return stretch.begin < end && stretch.end > start;
  });
}

void ImuQuality::Forget(TimeNs before) {
  while (!stretches_.empty() && stretches_.front().end < before) stretches_.pop_front();
}

std::vector<std::string> ImuQuality::Notices() const {
  std::vector<std::string> notices;
  if (gaps_ > 0) {
    notices.push_back(Concatenate(gaps_, " gaps in the IMU, the longest ", longest_gap_,
                                  " s: images and wheels bridge them"));
  }
  if (saturated_ > 0) {
    notices.push_back(Concatenate("the IMU was at the end of its range ", saturated_,
                                  " times: it counts little there"));
  }
  return notices;
}

}  // namespace regolith
