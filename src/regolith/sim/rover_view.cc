// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rover_view.h"

#include <cmath>

#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kSunIlluminance = 1.3e5;  // lx, of the sun above the air at the Earth

}  // namespace

CameraMotion CameraMotionOf(const MotionState& motion, const SE3& T_imu_camera) {
  const Eigen::Quaterniond R_camera_imu = T_imu_camera.rotation.conjugate();
  const Eigen::Vector3d v_imu = motion.T_world_imu.rotation.conjugate() * motion.v_world_imu +
                                motion.angular_velocity_imu.cross(T_imu_camera.translation);
  return {(R_camera_imu * v_imu).cast<float>(),
          (R_camera_imu * motion.angular_velocity_imu).cast<float>()};
}

Lamp LampOnRover(const ScenarioOptions& options, const SE3& T_world_base) {
  const SE3 T_base_camera = BaseFromCamera(options.camera, "mono");
  Lamp lamp;
  lamp.place = (T_world_base * Eigen::Vector3d(T_base_camera.translation.x(), options.lamp.side,
                                               options.lamp.height))
                   .cast<float>();
  lamp.axis =
      (T_world_base.rotation * T_base_camera.rotation * Eigen::Vector3d::UnitZ()).cast<float>();
  lamp.irradiance = static_cast<float>(options.lamp.candela / kSunIlluminance);
  lamp.beam = static_cast<float>(options.lamp.beam_deg * kDegree);
  return lamp;
}

}  // namespace regolith
