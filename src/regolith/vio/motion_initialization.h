// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/geometry/nav_state.h"
#include "regolith/sensor/imu_sample.h"

namespace regolith {

/// What one image of a moving start saw: ids of tracks and their unit bearings (camera frame),
/// sorted by id.
struct BearingFrame {
  TimeNs time = 0;  ///< IMU's clock
  std::vector<std::pair<int64_t, Eigen::Vector3d>> bearings;
};

struct MotionStart {
  NavState state;  ///< at the first frame: level, at the origin, heading 0
  int landmarks = 0;
  double median_error = 0.0;  ///< rad, of bearings against the landmarks found
  double parallax = 0.0;      ///< rad, median of the landmarks' largest
};

/// Gyro bias (rad/s) with which the turns between frames agree best with epipolar geometry: the
/// normals of all epipolar planes of a pair lie in a plane (Kneip & Lynen 2013), whatever the
/// translation. Nothing where there are too few shared tracks.
std::optional<Eigen::Vector3d> EstimateGyroBias(Span<const BearingFrame> frames,
                                                Span<const ImuSample> samples,
                                                const SE3& T_imu_camera);

/// Velocity, gravity's direction and landmarks of a start in motion, in closed form from inertial
/// measurements and bearings (Dong-Si & Mourikis 2012), with gravity's magnitude (m/s²) known. The
/// accelerometer's bias counts as none. Nothing where the motion does not tell.
std::optional<MotionStart> InitializeInMotion(Span<const BearingFrame> frames,
                                              Span<const ImuSample> samples,
                                              const SE3& T_imu_camera, double gravity);

}  // namespace regolith
