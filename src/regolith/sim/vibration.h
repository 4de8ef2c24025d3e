// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/sim/scenario_options.h"

namespace regolith {

/// Band-limited shaking as sums of sinusoids, six axes: position (m, world) and yaw, pitch, roll
/// (rad), at unit envelope; the envelope is speed / reference speed.
class Vibration {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  struct Value {
    Vector6 value;
    Vector6 first;  ///< derivative by time
    Vector6 second;
  };

  Vibration(const VibrationOptions& options, uint64_t seed);

  /// At `time` s, with the envelope and its first two derivatives.
  Value At(double time, double envelope, double envelope_first, double envelope_second) const;

 private:
  struct Wave {
    double angular_frequency;  ///< rad/s
    double amplitude;          ///< m or rad
    double phase;              ///< rad
  };
  std::vector<Wave> waves_[6];
};

}  // namespace regolith
