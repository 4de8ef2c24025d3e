// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

/// How far the wheels' velocity is trusted. Slip lasts as long as a slope does, so it is a state
/// that wanders; what is left differs from sample to sample.
struct WheelVelocityOptions {
  double slip_sigma = 0.05;     ///< of the speed, at the start
  double slip_walk = 0.01;      ///< 1/√s, how fast slip changes
  double velocity_sigma = 0.1;  ///< m/s, of one sample, each axis: errors last for many of them
  double lateral_share = 0.1;   ///< of the speed: sliding to the side, more on each sample
  double vertical_share = 0.1;  ///< of the speed: the base's plane is not the ground's
  double turn_share = 0.3;      ///< m: of the rate of turn, the skidding that goes with it
  /// Multiplies all of these while the lidar tells all six directions, but for what the slip
  /// learns. Sliding lasts for seconds: beside a sensor without it, each sample says less of the
  /// motion than where the wheels are alone.
  double placed_inflation = 3.0;
};

struct InertialFilterOptions {
  double rest_velocity_sigma = 0.005;  ///< m/s, how still a rover at rest stands
  double moving_velocity_sigma =
      5.0;  ///< m/s, of the first velocity where the rover did not start at rest
  double moving_tilt_sigma =
      0.1;  ///< rad, of gravity's first direction where it did not start at rest
  /// Multiplies the rig's white-noise densities: vibration between samples is not in a data sheet.
  double noise_inflation = 3.0;
  WheelVelocityOptions wheels;
};

}  // namespace regolith
