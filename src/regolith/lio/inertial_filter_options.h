// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct InertialFilterOptions {
  double rest_velocity_sigma = 0.005;  ///< m/s, how still a rover at rest stands
  double moving_velocity_sigma =
      5.0;  ///< m/s, of the first velocity where the rover did not start at rest
  double moving_tilt_sigma =
      0.1;  ///< rad, of gravity's first direction where it did not start at rest
  /// Multiplies the rig's white-noise densities: vibration between samples is not in a data sheet.
  double noise_inflation = 3.0;
};

}  // namespace regolith
