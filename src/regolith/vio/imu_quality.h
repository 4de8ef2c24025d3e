// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "regolith/sensor/imu_sample.h"

namespace regolith {

/// Finds times at which an IMU says nothing: gaps between its samples, and samples at the end of
/// its range, where a value stays the same while the motion goes on.
class ImuQuality {
 public:
  /// `max_gap`: s. `gravity`: m/s².
  ImuQuality(double max_gap, double gravity) : max_gap_(max_gap), gravity_(gravity) {}

  /// Samples in order of their times.
  void Add(const ImuSample& sample);
  /// Whether a gap or saturation lies between the two times.
  bool IsDoubtful(TimeNs start, TimeNs end) const;
  void Forget(TimeNs before);
  std::vector<std::string> Notices() const;

 private:
  struct Stretch {
    TimeNs begin = 0;
    TimeNs end = 0;
  };

  bool IsStuck(double value, double last, double least) const;

  double max_gap_;
  double gravity_;
  std::deque<Stretch> stretches_;
  ImuSample last_;
  bool has_last_ = false;
  int stuck_ = 0;  ///< samples in a row with a value that does not change
  size_t gaps_ = 0;
  double longest_gap_ = 0.0;
  size_t saturated_ = 0;
};

}  // namespace regolith
