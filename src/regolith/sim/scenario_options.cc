// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/scenario_options.h"

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

void CheckRange(const std::string& key, double value, double low, double high,
                const std::string& unit) {
  if (value >= low && value <= high) return;
  throw InputError(
      key, Concatenate(value, " is out of bounds; expected ", low, " to ", high, " ", unit));
}

// Ground is made for the whole of a route.
constexpr double kFarthestWaypoint = 2000.0;  // m

void CheckWaypoints(const DriveOptions& drive) {
  const std::string& frame = drive.waypoint_frame;
  if (frame != "start" && frame != "map") {
    throw InputError("drive.waypoint_frame",
                     "\"" + frame + "\" is not known; expected start or map");
  }
  if (drive.route != "waypoints") return;
  const size_t count = drive.waypoints.size();
  if (count % 2 != 0 || count < (frame == "map" ? 4U : 2U)) {
    throw InputError("drive.waypoints",
                     Concatenate("has ", count, " numbers; expected x y of ",
                                 frame == "map" ? "two places or more" : "one place or more"));
  }
  for (const double coordinate : drive.waypoints) {
    CheckRange("drive.waypoints", coordinate, -kFarthestWaypoint, kFarthestWaypoint, "m");
  }
}

void CheckDrive(const DriveOptions& drive) {
  if (drive.route != "wander" && drive.route != "loops" && drive.route != "waypoints") {
    throw InputError("drive.route",
                     "\"" + drive.route + "\" is not known; expected wander, loops or waypoints");
  }
  CheckWaypoints(drive);
  CheckRange("drive.length", drive.length, 2.0, 5000.0, "m");
  CheckRange("drive.speed", drive.speed, 0.02, 2.0, "m/s");
  CheckRange("drive.rest", drive.rest, 0.5, 60.0, "s");
  CheckRange("drive.leg_duration", drive.leg_duration, 4.0, 600.0, "s");
  CheckRange("drive.stop", drive.stop, 0.0, 60.0, "s");
  CheckRange("drive.turn_deg", drive.turn_deg, 0.0, 180.0, "degrees");
  CheckRange("drive.turn_rate_deg", drive.turn_rate_deg, 1.0, 45.0, "degrees/s");
  CheckRange("drive.curvature", drive.curvature, 0.05, 0.5, "1/m");
  CheckRange("drive.max_slope_deg", drive.max_slope_deg, 2.0, 30.0, "degrees");
  CheckRange("drive.wanted_slope_deg", drive.wanted_slope_deg, 0.0, drive.max_slope_deg, "degrees");
}

void CheckRover(const RoverOptions& rover) {
  if (rover.wheels != 4 && rover.wheels != 6) {
    throw InputError("rover.wheels",
                     Concatenate(rover.wheels, " is not possible; expected 4 or 6"));
  }
  CheckRange("rover.wheel_radius", rover.wheel_radius, 0.05, 0.2, "m");
  CheckRange("rover.rocker_travel", rover.rocker_travel, 0.01, 0.4, "m");
}

void CheckImu(const ImuOptions& imu) {
  CheckRange("imu.rate", imu.rate, 50.0, 5000.0, "Hz");
  CheckRange("imu.gyro_scale_sigma", imu.gyro_scale_sigma, 0.0, 0.1, "(share)");
  CheckRange("imu.accelerometer_scale_sigma", imu.accelerometer_scale_sigma, 0.0, 0.1, "(share)");
  CheckRange("imu.gyro_misalignment_deg", imu.gyro_misalignment_deg, 0.0, 5.0, "degrees");
  CheckRange("imu.accelerometer_misalignment_deg", imu.accelerometer_misalignment_deg, 0.0, 5.0,
             "degrees");
}

void CheckCamera(const CameraOptions& camera) {
  CheckRange("camera.width", camera.width, 64, 4096, "pixels");
  CheckRange("camera.height", camera.height, 48, 4096, "pixels");
  CheckRange("camera.field_of_view_deg", camera.field_of_view_deg, 10.0, 130.0, "degrees");
  CheckRange("camera.rate", camera.rate, 0.1, 100.0, "Hz");
  CheckRange("camera.mast", camera.mast, 0.2, 5.0, "m");
  CheckRange("camera.pitch_deg", camera.pitch_deg, -45.0, 80.0, "degrees down");
  CheckRange("camera.baseline", camera.baseline, 0.02, 1.0, "m");
  CheckRange("camera.vignetting", camera.vignetting, 0.0, 0.9, "(share)");
  CheckRange("camera.min_exposure", camera.min_exposure, 1e-5, 1.0, "s");
  CheckRange("camera.max_exposure", camera.max_exposure, camera.min_exposure, 1.0, "s");
  CheckRange("camera.max_gain", camera.max_gain, 1.0, 1000.0, "");
  CheckRange("camera.lens_blur", camera.lens_blur, 0.0, 0.6, "pixels");
  CheckRange("camera.full_well", camera.full_well, 100.0, 1e6, "electrons");
  CheckRange("camera.read_noise", camera.read_noise, 0.0, 1000.0, "electrons");
  CheckRange("camera.time_offset", camera.time_offset, -0.1, 0.1, "s");
  CheckRange("camera.time_offset_sigma", camera.time_offset_sigma, 0.0, 0.1, "s");
  if (camera.distortion.size() != 4) {
    throw InputError("camera.distortion", Concatenate("has ", camera.distortion.size(),
                                                      " numbers; expected k1 k2 p1 p2"));
  }
}

void CheckLidar(const LidarOptions& lidar) {
  CheckRange("lidar.rings", lidar.rings, 1, 128, "rings");
  CheckRange("lidar.lowest_deg", lidar.lowest_deg, -90.0, 90.0, "degrees");
  CheckRange("lidar.highest_deg", lidar.highest_deg, lidar.lowest_deg, 90.0, "degrees");
  CheckRange("lidar.rate", lidar.rate, 1.0, 50.0, "Hz");
  CheckRange("lidar.firings", lidar.firings, 36, 10000, "a turn");
  CheckRange("lidar.min_range", lidar.min_range, 0.0, 10.0, "m");
  CheckRange("lidar.max_range", lidar.max_range, lidar.min_range + 1.0, 1000.0, "m");
  CheckRange("lidar.range_sigma", lidar.range_sigma, 0.0, 1.0, "m");
  CheckRange("lidar.dropout", lidar.dropout, 0.0, 0.5, "(share)");
  CheckRange("lidar.mast", lidar.mast, 0.2, 5.0, "m");
  const double cycle = 1.0 / (lidar.rate * lidar.firings * lidar.rings);
  CheckRange("lidar.laser_interval", lidar.laser_interval, 0.0, cycle, "s");
  CheckRange("lidar.divergence_across", lidar.divergence_across, 0.0, 0.05, "rad");
  CheckRange("lidar.divergence_along", lidar.divergence_along, 0.0, 0.05, "rad");
  CheckRange("lidar.dust_returns", lidar.dust_returns, 0.0, 0.1, "(share)");
}

void CheckWheels(const WheelOptions& wheels) {
  CheckRange("wheels.rate", wheels.rate, 1.0, 500.0, "Hz");
  if (wheels.slip.size() != 4) {
    throw InputError("wheels.slip", Concatenate("has ", wheels.slip.size(),
                                                " numbers; expected slip at 0, 5, 10, 15 degrees"));
  }
  for (const double slip : wheels.slip) CheckRange("wheels.slip", slip, 0.0, 0.9, "(share)");
  CheckRange("wheels.slip_spread", wheels.slip_spread, 0.0, 1.0, "(share)");
  CheckRange("wheels.turn_error", wheels.turn_error, 0.0, 0.5, "(share)");
  CheckRange("wheels.radius_error", wheels.radius_error, 0.0, 0.2, "(share)");
}

void CheckLight(const SunOptions& sun, const LampOptions& lamp) {
  CheckRange("lamp.candela", lamp.candela, 0.0, 1e6, "cd");
  CheckRange("lamp.beam_deg", lamp.beam_deg, 1.0, 80.0, "degrees");
  CheckRange("lamp.height", lamp.height, 0.1, 3.0, "m");
  CheckRange("lamp.side", lamp.side, -1.0, 1.0, "m");
  CheckRange("sun.elevation_deg", sun.elevation_deg, -90.0, 90.0, "degrees");
  if (sun.elevation_deg <= 0.0 && lamp.candela <= 0.0) {
    throw InputError("sun.elevation_deg",
                     Concatenate(sun.elevation_deg,
                                 " is below the horizon: cameras would see nothing; expected more "
                                 "than 0 degrees, or a lamp (lamp.candela)"));
  }
  CheckRange("sun.azimuth_deg", sun.azimuth_deg, -360.0, 360.0, "degrees");
  CheckRange("sun.tau", sun.tau, 0.0, 5.0, "");
}

void CheckMesh(const MeshOptions& mesh) {
  if (mesh.spacing != 0.005 && mesh.spacing != 0.01 && mesh.spacing != 0.02 &&
      mesh.spacing != 0.04) {
    throw InputError("mesh.spacing",
                     Concatenate(mesh.spacing, " is not one of 0.005, 0.01, 0.02 and 0.04 m"));
  }
  CheckRange("mesh.reach", mesh.reach, 20.0, 20000.0, "m");
}

}  // namespace

void ScenarioOptions::Check() const {
  if (planet != "moon" && planet != "mars") {
    throw InputError("planet", "\"" + planet + "\" is not known; expected moon or mars");
  }
  CheckRange("gravity", gravity, 1.2, 26.0, "m/s²");
  CheckDrive(drive);
  CheckRover(rover);
  CheckRange("duration", duration, drive.rest + 1.0, 36000.0, "s (it starts with a rest)");
  terrain.Check();
  CheckLight(sun, lamp);
  CheckCamera(camera);
  CheckLidar(lidar);
  CheckImu(imu);
  CheckRange("vibration.acceleration", vibration.acceleration, 0.0, 20.0, "m/s²");
  CheckRange("vibration.angular_rate", vibration.angular_rate, 0.0, 2.0, "rad/s");
  CheckRange("vibration.reference_speed", vibration.reference_speed, 0.01, 5.0, "m/s");
  CheckRange("vibration.min_frequency", vibration.min_frequency, 0.5, 200.0, "Hz");
  CheckRange("vibration.max_frequency", vibration.max_frequency, vibration.min_frequency, 500.0,
             "Hz");
  CheckWheels(wheels);
  CheckMesh(mesh);
}

void ScenarioOptions::MakeDraft() {
  constexpr double kDraftSpacing = 0.04;  // m
  mesh.spacing = kDraftSpacing;
  mesh.interreflection = false;
}

}  // namespace regolith
