// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "regolith/sensor/imu_noise.h"
#include "regolith/sim/mesh_options.h"
#include "regolith/terrain/terrain_options.h"

namespace regolith {

/// How the rover drives: rest, then legs of driving with a stop and a point turn between them. The
/// route is planned on the ground (drive_planner.h).
struct DriveOptions {
  /// "wander": ahead, with gentle curves. "loops": two laps that come back to the old track, first
  /// in the old direction, then facing the other way. "waypoints": along the list.
  std::string route = "wander";
  double length = 60.0;           ///< m, of the route (wander, loops); at its end the rover rests
  std::vector<double> waypoints;  ///< m, x y of each
  std::string waypoint_frame = "start";  ///< "start": from the first pose on; "map": the terrain's
  double speed = 0.5;                    ///< m/s, nominal; legs run up to 1.18 times as fast
  double rest = 3.0;                     ///< s at rest before the first leg
  double leg_duration = 18.0;            ///< s of driving between two stops
  double stop = 0.4;                     ///< s at rest before and after a point turn
  double turn_deg = 30.0;                ///< angle of a point turn where the way is free, degrees
  double turn_rate_deg = 20.0;           ///< peak rate of a point turn, degrees/s
  double curvature = 0.2;                ///< 1/m, of the sharpest curve
  double max_slope_deg = 15.0;           ///< degrees; body and ground over 1 m stay below
  double wanted_slope_deg = 10.0;  ///< degrees; places are preferred whose route has such slopes
};

/// What the rover stands on.
struct RoverOptions {
  int wheels = 4;               ///< 4, on rockers; 6, on rockers and bogies
  double wheel_radius = 0.15;   ///< m
  double rocker_travel = 0.18;  ///< m a wheel goes up or down from the body's level
};

/// Where the sun stands, and what the sky adds.
struct SunOptions {
  double elevation_deg = 12.0;  ///< above the horizon
  double azimuth_deg = 65.0;    ///< from the rover's first heading (x) towards y (left)
  double tau = 0.0;             ///< optical depth of the dust; 0 has no sky light
};

/// A headlight beside the cameras.
struct LampOptions {
  double candela = 0.0;    ///< cd on the axis; 0 is off. A pair of 10,000 lm LED lamps has 20,000
  double beam_deg = 35.0;  ///< degrees off the axis where it sends half as much
  double height = 0.9;     ///< m above the ground
  double side = 0.25;      ///< m to the left of the cameras
};

/// The three cameras; all have these intrinsics.
struct CameraOptions {
  int width = 640;                                              ///< pixels
  int height = 480;                                             ///< pixels
  double field_of_view_deg = 80.0;                              ///< across
  double rate = 10.0;                                           ///< Hz
  double mast = 1.1;                                            ///< m above the ground
  double pitch_deg = 15.0;                                      ///< degrees down
  bool stereo = true;                                           ///< left and right beside "mono"
  double baseline = 0.12;                                       ///< m, left to right
  std::vector<double> distortion = {-0.12, 0.03, 4e-4, -3e-4};  ///< k1 k2 p1 p2
  double vignetting = 0.25;                                     ///< light lost at a corner, share
  double min_exposure = 0.002;                                  ///< s
  double max_exposure = 0.020;                                  ///< s
  double max_gain = 8.0;             ///< amplification where the longest exposure is too dark
  double lens_blur = 0.35;           ///< pixels, standard deviation of the lens' point spread
  bool motion_blur = true;           ///< the image is smeared by the motion while it is exposed
  bool noise = true;                 ///< shot and read noise
  double full_well = 10700.0;        ///< electrons at 255 (IMX255: EMVA data sheet)
  double read_noise = 10.0;          ///< electrons
  double time_offset = 0.004;        ///< s; stamp = true mid-exposure + this; not in the rig
  double time_offset_sigma = 0.005;  ///< s; what the rig says of it
};

struct LidarOptions {
  int rings = 16;
  double lowest_deg = -15.0;         ///< elevation of ring 0
  double highest_deg = 15.0;         ///< elevation of the last ring
  double rate = 10.0;                ///< turns a second
  int firings = 1800;                ///< a turn
  double min_range = 0.5;            ///< m
  double max_range = 100.0;          ///< m
  double range_sigma = 0.02;         ///< m
  double dropout = 0.05;             ///< mean share lost of the rays that meet ground within 30 m
  double mast = 1.2;                 ///< m above the ground
  double laser_interval = 2.304e-6;  ///< s between two lasers of a firing (VLP-16 manual)
  double divergence_across = 0.003;  ///< rad, of a beam (VLS-128 manual)
  double divergence_along = 0.0015;  ///< rad, up and down
  double dust_returns = 0.0;         ///< share of the beams that dust near the rover sends back
};

struct ImuOptions {
  double rate = 200.0;  ///< Hz
  ImuNoise noise;
  /// Standard deviations, an axis, of errors that the rig does not tell.
  double gyro_scale_sigma = 0.0;           ///< share
  double accelerometer_scale_sigma = 0.0;  ///< share
  double gyro_misalignment_deg = 0.0;      ///< degrees, of an axis towards another
  double accelerometer_misalignment_deg = 0.0;
};

/// Shaking of the body at the reference speed; proportional to speed.
struct VibrationOptions {
  double acceleration = 0.3;     ///< m/s² RMS, an axis
  double angular_rate = 0.02;    ///< rad/s RMS, an axis
  double reference_speed = 0.5;  ///< m/s
  double min_frequency = 5.0;    ///< Hz
  double max_frequency = 40.0;   ///< Hz
};

struct WheelOptions {
  double rate = 50.0;  ///< Hz
  /// Slip at 0, 5, 10 and 15 degrees uphill (VIPER tilt bed, Hu et al. 2024).
  std::vector<double> slip = {0.025, 0.05, 0.10, 0.35};
  double slip_spread = 1.0 / 3.0;  ///< standard deviation, share of the slip
  double turn_error = 0.10;        ///< share of the yaw rate in a point turn
  double radius_error = 0.01;      ///< share of the wheels' radius
};

/// A simulated drive: everything that a recording depends on, beside the elevation model.
struct ScenarioOptions {
  std::string planet = "moon";  ///< "moon" or "mars": photometry and sky
  double gravity = 1.62;        ///< m/s²
  double duration = 40.0;       ///< s
  uint64_t seed = 1;
  TerrainOptions terrain;
  DriveOptions drive;
  RoverOptions rover;
  SunOptions sun;
  LampOptions lamp;
  CameraOptions camera;
  LidarOptions lidar;
  ImuOptions imu;
  VibrationOptions vibration;
  WheelOptions wheels;
  MeshOptions mesh;

  /// Throws InputError that names the key, the value and what was expected.
  void Check() const;
  /// Makes it quick at the price of quality: a mesh of 4 cm at best, shadows that lit ground does
  /// not fill.
  void MakeDraft();
};

}  // namespace regolith
