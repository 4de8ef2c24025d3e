// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"

namespace regolith {

/// When a window of inertial measurements counts as rest. Limits on forces are shares of gravity,
/// so that they hold on every planet.
struct RestDetectionOptions {
  double min_duration = 0.5;            ///< s that the window must cover
  double max_gyro_sigma = 0.01;         ///< rad/s, standard deviation of the worst axis
  double max_force_sigma_share = 0.05;  ///< of gravity, standard deviation of the worst axis
  double max_mean_rate = 0.05;          ///< rad/s, norm of the mean; leaves room for the bias
  double max_force_error_share = 0.25;  ///< of gravity, | |mean force| - gravity |

  void Check() const {
    REGOLITH_CHECK(min_duration > 0.0, "min_duration ", min_duration);
    REGOLITH_CHECK(max_gyro_sigma > 0.0, "max_gyro_sigma ", max_gyro_sigma);
    REGOLITH_CHECK(max_force_sigma_share > 0.0, "max_force_sigma_share ", max_force_sigma_share);
    REGOLITH_CHECK(max_mean_rate > 0.0, "max_mean_rate ", max_mean_rate);
    REGOLITH_CHECK(max_force_error_share > 0.0, "max_force_error_share ", max_force_error_share);
  }
};

}  // namespace regolith
