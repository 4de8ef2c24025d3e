// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/vio_options.h"

#include "regolith/core/check.h"

namespace regolith {

void VioWheelOptions::Check() const {
  REGOLITH_CHECK(slip_sigma > 0.0, "slip_sigma ", slip_sigma);
  REGOLITH_CHECK(slip_walk > 0.0, "slip_walk ", slip_walk);
  REGOLITH_CHECK(floor > 0.0, "floor ", floor);
  REGOLITH_CHECK(loss_scale > 0.0, "loss_scale ", loss_scale);
  for (const double share : {along_share, lateral_share, vertical_share, turn_share}) {
    REGOLITH_CHECK(share >= 0.0, "share ", share);
  }
}

void VioOptions::Check() const {
  REGOLITH_CHECK(keyframes >= 3, "keyframes ", keyframes);
  REGOLITH_CHECK(max_landmarks >= 10, "max_landmarks ", max_landmarks);
  REGOLITH_CHECK(keyframe_iterations > 0, "keyframe_iterations ", keyframe_iterations);
  REGOLITH_CHECK(frame_iterations > 0, "frame_iterations ", frame_iterations);
  REGOLITH_CHECK(keyframe_shared >= 0.0 && keyframe_shared < 1.0, "keyframe_shared ",
                 keyframe_shared);
  REGOLITH_CHECK(min_features >= 4, "min_features ", min_features);
  for (const double positive : {keyframe_parallax,
                                keyframe_turn,
                                pixel_sigma,
                                loss_scale,
                                outlier,
                                min_parallax,
                                expected_distance,
                                inverse_distance_sigma,
                                noise_inflation,
                                extrinsics_rotation_sigma,
                                extrinsics_position_sigma,
                                rest_velocity_sigma,
                                rest_position_sigma,
                                rest_rotation_sigma,
                                rest_pixels,
                                rest_max_rate,
                                rest_window,
                                initialization_window,
                                moving_window,
                                moving_velocity_sigma,
                                moving_tilt_sigma,
                                min_imu_rate,
                                max_imu_gap,
                                max_gyro_bias,
                                max_accelerometer_bias,
                                max_jump_speed}) {
    REGOLITH_CHECK(positive > 0.0, "value ", positive);
  }
  rest.Check();
  wheel.Check();
}

}  // namespace regolith
