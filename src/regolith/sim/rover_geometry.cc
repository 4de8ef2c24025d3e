// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rover_geometry.h"

#include <cmath>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kMastForward = 0.35;  // m, of the mast before the base
constexpr double kImuHeight = 0.45;    // m

}  // namespace

SE3 BaseFromImu() {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.05, 0.0, kImuHeight)};
}

SE3 BaseFromLidar(const LidarOptions& options) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(kMastForward, 0.0, options.mast)};
}

std::vector<std::string> CameraNames(const CameraOptions& options) {
  if (!options.stereo) return {"mono"};
  return {"mono", "left", "right"};
}

SE3 BaseFromCamera(const CameraOptions& options, const std::string& camera) {
  REGOLITH_CHECK(camera == "mono" || camera == "left" || camera == "right", camera);
  const double sine = std::sin(options.pitch_deg * kDegree);
  const double cosine = std::cos(options.pitch_deg * kDegree);
  Eigen::Matrix3d R_base_camera;
  R_base_camera.col(0) = Eigen::Vector3d(0.0, -1.0, 0.0);
  R_base_camera.col(1) = Eigen::Vector3d(-sine, 0.0, -cosine);
  R_base_camera.col(2) = Eigen::Vector3d(cosine, 0.0, -sine);
  double side = 0.0;
  if (camera == "left") side = 0.5 * options.baseline;
  if (camera == "right") side = -0.5 * options.baseline;
  return {Eigen::Quaterniond(R_base_camera).normalized(),
          Eigen::Vector3d(kMastForward + 0.08, side, options.mast)};
}

std::vector<RoverBox> RoverBody() {
  const auto box = [](double x, double y, double z, double half_x, double half_y, double half_z) {
    return RoverBox{SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, y, z)),
                    Eigen::Vector3d(half_x, half_y, half_z)};
  };
  std::vector<RoverBox> body = {box(-0.05, 0.0, 0.40, 0.45, 0.26, 0.12),   // chassis
                                box(-0.10, 0.0, 0.54, 0.52, 0.40, 0.015),  // solar deck
                                box(kMastForward, 0.0, 0.82, 0.03, 0.03, 0.28),
                                box(kMastForward + 0.03, 0.0, 1.08, 0.05, 0.11, 0.04),
                                box(-0.45, 0.25, 0.90, 0.015, 0.015, 0.38)};  // antenna
  for (const double x : {kHalfWheelbase, -kHalfWheelbase}) {
    for (const double y : {kHalfTrack, -kHalfTrack}) {
      body.push_back(box(x, y, 0.15, 0.13, 0.08, 0.13));
    }
  }
  return body;
}

CameraIntrinsics MakeIntrinsics(const CameraOptions& options) {
  CameraIntrinsics intrinsics;
  intrinsics.width = options.width;
  intrinsics.height = options.height;
  for (size_t i = 0; i < 4; ++i) intrinsics.distortion[i] = options.distortion[i];
  const double radius = std::tan(0.5 * options.field_of_view_deg * kDegree);
  const double squared = radius * radius;
  const double distorted = radius * (1.0 + intrinsics.distortion[0] * squared +
                                     intrinsics.distortion[1] * squared * squared);
  const double focal = 0.5 * options.width / distorted;
  intrinsics.focal = Eigen::Vector2d(focal, focal);
  intrinsics.principal_point =
      Eigen::Vector2d(0.5 * (options.width - 1) + 1.7, 0.5 * (options.height - 1) - 2.3);
  return intrinsics;
}

RigCalibration NominalRig(const ScenarioOptions& options, const std::vector<std::string>& cameras) {
  RigCalibration rig;
  rig.gravity = options.gravity;
  rig.imu.emplace();
  rig.imu->rate = options.imu.rate;
  rig.imu->noise = options.imu.noise;
  const SE3 T_imu_base = BaseFromImu().Inverse();
  rig.lidar.emplace();
  rig.lidar->T_imu_lidar = T_imu_base * BaseFromLidar(options.lidar);
  rig.lidar->rings = options.lidar.rings;
  rig.lidar->period = 1.0 / options.lidar.rate;
  rig.lidar->min_range = options.lidar.min_range;
  rig.lidar->max_range = options.lidar.max_range;
  rig.lidar->range_sigma = std::max(options.lidar.range_sigma, 1e-3);
  rig.lidar->lowest_elevation_deg = options.lidar.lowest_deg;
  rig.lidar->highest_elevation_deg = options.lidar.highest_deg;
  for (const std::string& name : cameras) {
    CameraCalibration& camera = rig.cameras[name];
    camera.topic = "/camera/" + name + "/image_raw";
    camera.intrinsics = MakeIntrinsics(options.camera);
    camera.T_imu_camera = T_imu_base * BaseFromCamera(options.camera, name);
    camera.time_offset_sigma = options.camera.time_offset_sigma;
    camera.rate = options.camera.rate;
  }
  rig.wheels.emplace();
  rig.wheels->T_imu_base = T_imu_base;
  return rig;
}

}  // namespace regolith
