// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sensor/rig_calibration.h"

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

// Titan's 1.35 to Jupiter's 24.8 m/s². One Earth gravity and its parts (Moon 0.165, Mars 0.38) stay
// below.
constexpr double kLeastGravity = 1.2;
constexpr double kMostGravity = 26.0;
constexpr double kRotationTolerance = 1e-4;

void CheckRange(const std::string& key, double value, double low, double high,
                const std::string& unit) {
  if (value >= low && value <= high) return;
  throw InputError(
      key, Concatenate(value, " is out of bounds; expected ", low, " to ", high, " ", unit));
}

void CheckGravity(double gravity) {
  if (gravity >= kLeastGravity && gravity <= kMostGravity) return;
  throw InputError("gravity", Concatenate(gravity,
                                          " is not plausible; expected m/s² (Moon 1.62, Mars 3.72, "
                                          "Earth 9.81), not multiples of g"));
}

void CheckImu(const ImuCalibration& imu) {
  CheckRange("imu.rate", imu.rate, 1.0, 20000.0, "Hz");
  const ImuNoise& noise = imu.noise;
  CheckRange("imu.gyro_density", noise.gyro_density, 1e-8, 0.1, "rad/s/√Hz");
  CheckRange("imu.gyro_walk", noise.gyro_walk, 0.0, 0.1, "rad/s²/√Hz");
  CheckRange("imu.accelerometer_density", noise.accelerometer_density, 1e-7, 1.0, "m/s²/√Hz");
  CheckRange("imu.accelerometer_walk", noise.accelerometer_walk, 0.0, 1.0, "m/s³/√Hz");
  CheckRange("imu.gyro_bias_sigma", noise.gyro_bias_sigma, 0.0, 1.0, "rad/s");
  CheckRange("imu.accelerometer_bias_sigma", noise.accelerometer_bias_sigma, 0.0, 5.0, "m/s²");
}

void CheckLidar(const LidarCalibration& lidar) {
  CheckRange("lidar.rings", lidar.rings, 1, 1024, "rings");
  CheckRange("lidar.time_offset", lidar.time_offset, -10.0, 10.0, "s");
  CheckRange("lidar.period", lidar.period, 0.005, 10.0, "s");
  CheckRange("lidar.min_range", lidar.min_range, 0.0, 50.0, "m");
  CheckRange("lidar.max_range", lidar.max_range, lidar.min_range + 1.0, 2000.0, "m");
  CheckRange("lidar.range_sigma", lidar.range_sigma, 1e-4, 1.0, "m");
  CheckRange("lidar.lowest_elevation_deg", lidar.lowest_elevation_deg, -90.0, 90.0, "degrees");
  CheckRange("lidar.highest_elevation_deg", lidar.highest_elevation_deg, lidar.lowest_elevation_deg,
             90.0, "degrees");
}

void CheckCamera(const std::string& name, const CameraCalibration& camera) {
  const std::string key = "cameras." + name;
  CheckRange(key + ".time_offset", camera.time_offset, -10.0, 10.0, "s");
  CheckRange(key + ".time_offset_sigma", camera.time_offset_sigma, 0.0, 1.0, "s");
  CheckRange(key + ".rate", camera.rate, 0.01, 1000.0, "Hz");
  try {
    CameraModel::Create(camera.intrinsics);
  } catch (const InputError& error) {
    throw InputError(key, error.what());
  }
}

void CheckTranslation(const std::string& key, const SE3& transform) {
  if (transform.translation.allFinite() && transform.translation.norm() < 50.0) return;
  throw InputError(key, Concatenate("translation of ", transform.translation.norm(),
                                    " m is not plausible on a rover; expected metres"));
}

}  // namespace

void RigCalibration::Check() const {
  CheckGravity(gravity);
  if (imu) CheckImu(*imu);
  if (lidar) {
    CheckLidar(*lidar);
    CheckTranslation("lidar.T_imu_lidar", lidar->T_imu_lidar);
  }
  for (const auto& [name, camera] : cameras) {
    CheckCamera(name, camera);
    CheckTranslation("cameras." + name + ".T_imu_camera", camera.T_imu_camera);
  }
  if (wheels) CheckTranslation("wheels.T_imu_base", wheels->T_imu_base);
}

SE3 TransformFromMatrix(const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite()) throw InputError("holds a value that is not finite");
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() > kRotationTolerance) {
    throw InputError("the last row of a transform must be 0 0 0 1 (is the matrix transposed?)");
  }
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (error > 10.0 * kRotationTolerance) {
    throw InputError(Concatenate("the upper left 3 × 3 is not a rotation: |R Rᵀ - I| = ", error,
                                 "; its rows must be orthogonal unit vectors"));
  }
  if (rotation.determinant() < 0.0) {
    throw InputError("the rotation is reflected (determinant -1): one axis has the wrong sign");
  }
  return SE3::FromMatrix(matrix);
}

}  // namespace regolith
