// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/imu/rest_detection_options.h"

namespace regolith {

/// How far the wheels' way between two frames is trusted, beside the slip that is estimated.
struct VioWheelOptions {
  double slip_sigma = 0.05;     ///< of the way, at the start
  double slip_walk = 0.02;      ///< 1/√s, how fast slip changes
  double along_share = 0.03;    ///< of the way, 1 σ of what the slip does not explain
  double lateral_share = 0.05;  ///< of the way: sliding to the side
  double vertical_share = 0.1;  ///< of the way: the base's plane is not the ground's
  double turn_share = 0.1;      ///< m: of the angle turned, the skidding that goes with it
  double floor = 2e-3;          ///< m, at rest
  double loss_scale = 2.0;      ///< standard deviations; beyond, a way counts less (Huber)

  void Check() const;
};

/// A visual–inertial sliding window.
struct VioOptions {
  bool wheels = false;              ///< wheel odometry in the window, where the rig has it
  bool stereo = false;              ///< the right camera gives distances, where the rig has one
  int keyframes = 10;               ///< of the window
  int max_landmarks = 150;          ///< tracks that are used, the longest first
  int keyframe_iterations = 6;      ///< of the solver, at a keyframe
  int frame_iterations = 2;         ///< of the solver, at another frame
  double keyframe_parallax = 10.0;  ///< pixels, median, turning taken off: a keyframe
  double keyframe_shared = 0.5;     ///< of the last keyframe's features, below which there is one
  double keyframe_turn = 0.2;       ///< rad since the last keyframe, above which there is one
  double pixel_sigma = 0.7;         ///< pixels, of where a feature is seen
  double loss_scale = 1.5;         ///< standard deviations; beyond, a sighting counts less (Cauchy)
  double outlier = 4.0;            ///< standard deviations; beyond, a sighting is left out
  double min_parallax = 0.01;      ///< rad, of a landmark that is triangulated
  double expected_distance = 4.0;  ///< m, of landmarks without parallax
  double inverse_distance_sigma = 5.0;  ///< 1/m, of that guess: hardly any, since many guesses
  double noise_inflation = 1.5;         ///< of the IMU's white noise: vibration is in no data sheet
  bool refine_extrinsics = false;       ///< T_imu_camera is estimated
  double extrinsics_rotation_sigma = 0.02;  ///< rad, of the rig's, where it is estimated
  double extrinsics_position_sigma = 0.01;  ///< m
  /// The camera's time offset is estimated where the rig says that it is not known exactly.
  bool refine_time_offset = true;
  bool zero_velocity = true;            ///< a rover that stands still is told so
  double rest_velocity_sigma = 0.02;    ///< m/s, how still it stands: motion begins unseen
  double rest_position_sigma = 0.001;   ///< m
  double rest_rotation_sigma = 0.0005;  ///< rad
  double rest_pixels = 0.5;             ///< median motion of features between images, at rest below
  double rest_max_rate = 0.01;          ///< rad/s, off the gyro's bias: a faster turn is no rest
  RestDetectionOptions rest;
  double rest_window = 0.5;            ///< s of IMU samples that must be still
  double initialization_window = 1.0;  ///< s at rest before the first state
  double moving_window = 1.5;          ///< s of images from which motion is started
  double moving_velocity_sigma = 0.3;  ///< m/s, of a start in motion
  double moving_tilt_sigma = 0.05;     ///< rad, of gravity's direction at a start in motion
  double min_imu_rate = 50.0;          ///< Hz; a slower IMU is reported, and nothing starts with it
  double max_imu_gap = 0.1;            ///< s between samples; a longer one is reported
  int min_features = 15;       ///< fewer landmarks in an image: nothing is said of the motion
  double max_gyro_bias = 0.3;  ///< rad/s
  double max_accelerometer_bias = 1.5;  ///< m/s²
  double max_jump_speed = 3.0;          ///< m/s, of a correction between two images
  VioWheelOptions wheel;

  /// Throws CheckError on values that make no odometry.
  void Check() const;
};

}  // namespace regolith
