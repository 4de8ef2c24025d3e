// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

/// Continuous-time noise of an IMU, as in its data sheet's Allan deviation. Defaults: ADIS16448
/// (EuRoC).
struct ImuNoise {
  double gyro_density = 1.7e-4;            ///< rad/s/√Hz
  double gyro_walk = 2e-5;                 ///< rad/s²/√Hz
  double accelerometer_density = 2e-3;     ///< m/s²/√Hz
  double accelerometer_walk = 3e-3;        ///< m/s³/√Hz
  double gyro_bias_sigma = 5e-3;           ///< rad/s, of the bias at switch-on, an axis
  double accelerometer_bias_sigma = 0.05;  ///< m/s², of the bias at switch-on, an axis
};

}  // namespace regolith
