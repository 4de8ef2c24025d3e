// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/scenario_config.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "regolith/core/version.h"

namespace regolith {

template <typename Archive>
void Fields(Archive& archive, ReliefOptions& relief) {
  archive("hurst", relief.hurst);
  archive("slope_deg", relief.slope_deg);
  std::string statistic = relief.statistic == SlopeStatistic::kRms ? "rms" : "median";
  archive("statistic", statistic);
  if constexpr (Archive::kReading) {
    if (statistic != "rms" && statistic != "median") {
      archive.Fail("statistic", "`" + statistic + "`: expected median or rms");
    }
    relief.statistic = statistic == "rms" ? SlopeStatistic::kRms : SlopeStatistic::kMedian;
  }
  archive("longest_wavelength", relief.longest_wavelength);
  archive("shortest_wavelength", relief.shortest_wavelength);
}

template <typename Archive>
void Fields(Archive& archive, ExtraCrater& crater) {
  archive("x", crater.x);
  archive("y", crater.y);
  archive("diameter", crater.diameter);
  archive("depth", crater.depth);
}

template <typename Archive>
void Fields(Archive& archive, CraterOptions& craters) {
  archive("density", craters.density);
  archive("min_diameter", craters.min_diameter);
  archive("max_diameter", craters.max_diameter);
  archive("equilibrium_diameter", craters.equilibrium_diameter);
  archive("fresh_depth", craters.fresh_depth);
  archive("oldest_depth", craters.oldest_depth);
  archive("extra", craters.extra);
}

template <typename Archive>
void Fields(Archive& archive, RockOptions& rocks) {
  constexpr const char* kLaws[] = {"none", "power", "golombek"};
  std::string law = kLaws[static_cast<size_t>(rocks.law)];
  archive("law", law);
  if constexpr (Archive::kReading) {
    const auto* const found = std::find(std::begin(kLaws), std::end(kLaws), law);
    if (found == std::end(kLaws)) {
      archive.Fail("law", "`" + law + "`: expected none, power or golombek");
    }
    rocks.law = static_cast<RockLaw>(found - std::begin(kLaws));
  }
  archive("density", rocks.density);
  archive("exponent", rocks.exponent);
  archive("cover", rocks.cover);
  archive("min_diameter", rocks.min_diameter);
  archive("max_diameter", rocks.max_diameter);
  archive("clustering", rocks.clustering);
  archive("height_share", rocks.height_share);
}

template <typename Archive>
void Fields(Archive& archive, ClodOptions& clods) {
  archive("density", clods.density);
  archive("exponent", clods.exponent);
}

template <typename Archive>
void Fields(Archive& archive, RippleOptions& ripples) {
  archive("wavelength", ripples.wavelength);
  archive("height", ripples.height);
  archive("mega_wavelength", ripples.mega_wavelength);
  archive("mega_height", ripples.mega_height);
  archive("dune_wavelength", ripples.dune_wavelength);
  archive("dune_height", ripples.dune_height);
  archive("cover", ripples.cover);
  archive("direction_deg", ripples.direction_deg);
}

template <typename Archive>
void Fields(Archive& archive, AlbedoOptions& albedo) {
  archive("mean", albedo.mean);
  archive("contrast", albedo.contrast);
  archive("grain", albedo.grain);
  archive("patches", albedo.patches);
}

template <typename Archive>
void Fields(Archive& archive, TerrainOptions& terrain) {
  archive("relief", terrain.relief);
  archive("craters", terrain.craters);
  archive("rocks", terrain.rocks);
  archive("clods", terrain.clods);
  archive("ripples", terrain.ripples);
  archive("albedo", terrain.albedo);
}

template <typename Archive>
void Fields(Archive& archive, DriveOptions& drive) {
  archive("route", drive.route);
  archive("length", drive.length);
  archive("waypoints", drive.waypoints);
  archive("waypoint_frame", drive.waypoint_frame);
  archive("speed", drive.speed);
  archive("rest", drive.rest);
  archive("leg_duration", drive.leg_duration);
  archive("stop", drive.stop);
  archive("turn_deg", drive.turn_deg);
  archive("turn_rate_deg", drive.turn_rate_deg);
  archive("curvature", drive.curvature);
  archive("max_slope_deg", drive.max_slope_deg);
  archive("wanted_slope_deg", drive.wanted_slope_deg);
}

template <typename Archive>
void Fields(Archive& archive, RoverOptions& rover) {
  archive("wheels", rover.wheels);
  archive("wheel_radius", rover.wheel_radius);
  archive("rocker_travel", rover.rocker_travel);
}

template <typename Archive>
void Fields(Archive& archive, SunOptions& sun) {
  archive("elevation_deg", sun.elevation_deg);
  archive("azimuth_deg", sun.azimuth_deg);
  archive("tau", sun.tau);
}

template <typename Archive>
void Fields(Archive& archive, LampOptions& lamp) {
  archive("candela", lamp.candela);
  archive("beam_deg", lamp.beam_deg);
  archive("height", lamp.height);
  archive("side", lamp.side);
}

template <typename Archive>
void Fields(Archive& archive, CameraOptions& camera) {
  archive("width", camera.width);
  archive("height", camera.height);
  archive("field_of_view_deg", camera.field_of_view_deg);
  archive("rate", camera.rate);
  archive("mast", camera.mast);
  archive("pitch_deg", camera.pitch_deg);
  archive("stereo", camera.stereo);
  archive("baseline", camera.baseline);
  archive("distortion", camera.distortion);
  archive("vignetting", camera.vignetting);
  archive("min_exposure", camera.min_exposure);
  archive("max_exposure", camera.max_exposure);
  archive("max_gain", camera.max_gain);
  archive("lens_blur", camera.lens_blur);
  archive("motion_blur", camera.motion_blur);
  archive("noise", camera.noise);
  archive("full_well", camera.full_well);
  archive("read_noise", camera.read_noise);
  archive("time_offset", camera.time_offset);
  archive("time_offset_sigma", camera.time_offset_sigma);
}

template <typename Archive>
void Fields(Archive& archive, LidarOptions& lidar) {
  archive("rings", lidar.rings);
  archive("lowest_deg", lidar.lowest_deg);
  archive("highest_deg", lidar.highest_deg);
  archive("rate", lidar.rate);
  archive("firings", lidar.firings);
  archive("min_range", lidar.min_range);
  archive("max_range", lidar.max_range);
  archive("range_sigma", lidar.range_sigma);
  archive("dropout", lidar.dropout);
  archive("mast", lidar.mast);
  archive("laser_interval", lidar.laser_interval);
  archive("divergence_across", lidar.divergence_across);
  archive("divergence_along", lidar.divergence_along);
  archive("dust_returns", lidar.dust_returns);
}

template <typename Archive>
void Fields(Archive& archive, ImuOptions& imu) {
  archive("rate", imu.rate);
  archive("gyro_density", imu.noise.gyro_density);
  archive("gyro_walk", imu.noise.gyro_walk);
  archive("accelerometer_density", imu.noise.accelerometer_density);
  archive("accelerometer_walk", imu.noise.accelerometer_walk);
  archive("gyro_bias_sigma", imu.noise.gyro_bias_sigma);
  archive("accelerometer_bias_sigma", imu.noise.accelerometer_bias_sigma);
  archive("gyro_scale_sigma", imu.gyro_scale_sigma);
  archive("accelerometer_scale_sigma", imu.accelerometer_scale_sigma);
  archive("gyro_misalignment_deg", imu.gyro_misalignment_deg);
  archive("accelerometer_misalignment_deg", imu.accelerometer_misalignment_deg);
}

template <typename Archive>
void Fields(Archive& archive, VibrationOptions& vibration) {
  archive("acceleration", vibration.acceleration);
  archive("angular_rate", vibration.angular_rate);
  archive("reference_speed", vibration.reference_speed);
  archive("min_frequency", vibration.min_frequency);
  archive("max_frequency", vibration.max_frequency);
}

template <typename Archive>
void Fields(Archive& archive, WheelOptions& wheels) {
  archive("rate", wheels.rate);
  archive("slip", wheels.slip);
  archive("slip_spread", wheels.slip_spread);
  archive("turn_error", wheels.turn_error);
  archive("radius_error", wheels.radius_error);
}

template <typename Archive>
void Fields(Archive& archive, MeshOptions& mesh) {
  archive("spacing", mesh.spacing);
  archive("reach", mesh.reach);
  archive("interreflection", mesh.interreflection);
}

template <typename Archive>
void Fields(Archive& archive, ScenarioOptions& scenario) {
  archive("planet", scenario.planet);
  archive("gravity", scenario.gravity);
  archive("duration", scenario.duration);
  archive("seed", scenario.seed);
  archive("terrain", scenario.terrain);
  archive("drive", scenario.drive);
  archive("rover", scenario.rover);
  archive("sun", scenario.sun);
  archive("lamp", scenario.lamp);
  archive("camera", scenario.camera);
  archive("lidar", scenario.lidar);
  archive("imu", scenario.imu);
  archive("vibration", scenario.vibration);
  archive("wheels", scenario.wheels);
  archive("mesh", scenario.mesh);
}

ScenarioOptions LoadScenario(const YamlDocument& document) {
  ScenarioOptions options;
  FieldReader reader(document);
  Fields(reader, options);
  reader.Finish();
  reader.Check(options);
  return options;
}

std::string WriteScenario(const ScenarioOptions& options) {
  FieldWriter writer;
  ScenarioOptions copy = options;
  Fields(writer, copy);
  return "# Scenario of a recording made by regolith " + ProgramVersion() + ".\n" + writer.Text();
}

}  // namespace regolith
