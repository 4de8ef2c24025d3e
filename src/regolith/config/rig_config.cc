// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/rig_config.h"

#include <filesystem>

namespace regolith {
namespace {

constexpr char kHeader[] =
    "# Rig of one rover. T_a_b maps points of frame b into frame a; frames: imu (the body), lidar, "
    "camera\n"
    "# (z forward), base (wheels). SI units: m, s, m/s²; pixels for cameras. IMU noise as "
    "continuous-time densities:\n"
    "# gyro_density rad/s/√Hz, gyro_walk rad/s²/√Hz, accelerometer_density m/s²/√Hz, "
    "accelerometer_walk m/s³/√Hz;\n"
    "# *_bias_sigma: spread of the bias at switch-on, rad/s and m/s². time_offset: s to add to a "
    "sensor's stamps.\n"
    "# The mask of a camera is a PNG as large as its images, path from here, 0 where the rover "
    "sees its own "
    "parts.\n";

}  // namespace

template <typename Archive>
void Fields(Archive& archive, ImuCalibration& imu) {
  archive("topic", imu.topic);
  archive("rate", imu.rate);
  archive("gyro_density", imu.noise.gyro_density);
  archive("gyro_walk", imu.noise.gyro_walk);
  archive("accelerometer_density", imu.noise.accelerometer_density);
  archive("accelerometer_walk", imu.noise.accelerometer_walk);
  archive("gyro_bias_sigma", imu.noise.gyro_bias_sigma);
  archive("accelerometer_bias_sigma", imu.noise.accelerometer_bias_sigma);
}

template <typename Archive>
void Fields(Archive& archive, LidarCalibration& lidar) {
  archive("topic", lidar.topic);
  archive("T_imu_lidar", lidar.T_imu_lidar);
  archive("rings", lidar.rings);
  archive("lowest_elevation_deg", lidar.lowest_elevation_deg);
  archive("highest_elevation_deg", lidar.highest_elevation_deg);
  archive("period", lidar.period);
  archive("min_range", lidar.min_range);
  archive("max_range", lidar.max_range);
  archive("range_sigma", lidar.range_sigma);
  archive("time_offset", lidar.time_offset);
}

template <typename Archive>
void Fields(Archive& archive, CameraCalibration& camera) {
  archive("topic", camera.topic);
  CameraIntrinsics& intrinsics = camera.intrinsics;
  std::string model = CameraModelName(intrinsics.model);
  archive("model", model);
  if constexpr (Archive::kReading) {
    const auto type = CameraModelFromName(model);
    if (!type)
      archive.Fail("model", "`" + model + "`: expected pinhole, equidistant or kannala_brandt");
    intrinsics.model = *type;
  }
  archive("width", intrinsics.width);
  archive("height", intrinsics.height);
  Eigen::Vector4d numbers;
  numbers << intrinsics.focal, intrinsics.principal_point;
  archive("intrinsics", numbers);  // fx, fy, cx, cy
  intrinsics.focal = numbers.head<2>();
  intrinsics.principal_point = numbers.tail<2>();
  Eigen::Vector4d distortion(intrinsics.distortion.data());
  archive("distortion", distortion);  // k1, k2, p1, p2 or k1…k4
  std::copy(distortion.begin(), distortion.end(), intrinsics.distortion.begin());
  archive("T_imu_camera", camera.T_imu_camera);
  archive("rate", camera.rate);
  archive("time_offset", camera.time_offset);
  archive("time_offset_sigma", camera.time_offset_sigma);
  if (Archive::kReading || !camera.mask_file.empty()) archive("mask", camera.mask_file);
}

template <typename Archive>
void Fields(Archive& archive, WheelCalibration& wheels) {
  archive("topic", wheels.topic);
  archive("T_imu_base", wheels.T_imu_base);
}

template <typename Archive>
void Fields(Archive& archive, RigCalibration& rig) {
  archive("gravity", rig.gravity);
  archive("imu", rig.imu);
  archive("lidar", rig.lidar);
  archive("cameras", rig.cameras);
  archive("wheels", rig.wheels);
}

namespace {

/// Files that a rig names lie beside it; their paths are made to hold from anywhere, so that the
/// rig may be written elsewhere.
std::string BesideRig(const std::string& file, const std::string& rig_file) {
  if (file.empty() || std::filesystem::path(file).is_absolute()) return file;
  return std::filesystem::absolute(std::filesystem::path(rig_file).parent_path() / file)
      .lexically_normal()
      .string();
}

}  // namespace

RigCalibration LoadRig(const YamlDocument& document) {
  RigCalibration rig;
  FieldReader reader(document);
  Fields(reader, rig);
  reader.Finish();
  if (rig.imu && !reader.Has("gravity")) {
    reader.Fail(
        "gravity",
        "is missing; a rig with an IMU needs it in m/s² (Moon 1.62, Mars 3.72, Earth 9.81)");
  }
  for (auto& [name, camera] : rig.cameras) {
    camera.mask_file = BesideRig(camera.mask_file, document.name());
  }
  reader.Check(rig);
  return rig;
}

std::string WriteRig(const RigCalibration& rig) {
  FieldWriter writer;
  RigCalibration copy = rig;
  Fields(writer, copy);
  return kHeader + writer.Text();
}

}  // namespace regolith
