// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/imu/wheel_preintegration.h"

#include <algorithm>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

SE3 PoseAt(Span<const WheelOdometry> odometry, const WheelOdometry* not_earlier, TimeNs time) {
  if (not_earlier->time == time || not_earlier == odometry.begin()) {
    return not_earlier->T_odom_base;
  }
  const WheelOdometry& before = *(not_earlier - 1);
  const double fraction =
      SecondsBetween(before.time, time) / SecondsBetween(before.time, not_earlier->time);
  return Interpolate(before.T_odom_base, not_earlier->T_odom_base, fraction);
}

void AddStep(const SE3& from, const SE3& to, WheelDelta* delta) {
  delta->distance += (to.translation - from.translation).norm();
  delta->angle += AngleBetween(from.rotation, to.rotation);
}

Matrix6d Covariance(const WheelDelta& delta, const WheelPreintegrationOptions& options) {
  const double tilt = options.tilt_sigma_per_metre * delta.distance;
  Vector6d sigmas;
  sigmas << tilt, tilt,
      options.yaw_sigma_share * delta.angle + options.yaw_sigma_per_metre * delta.distance,
      options.distance_sigma_share * delta.distance, options.lateral_sigma_share * delta.distance,
      options.vertical_sigma_share * delta.distance;
  sigmas.head<3>().array() += options.floor_rotation_sigma;
  sigmas.tail<3>().array() += options.floor_position_sigma;

  // The chord of an arc lies halfway between its first and last heading.
  const Eigen::Matrix3d track = ExpSo3(0.5 * LogSo3(delta.T_from_to.rotation)).toRotationMatrix();
  Matrix6d covariance = sigmas.cwiseAbs2().asDiagonal();
  covariance.bottomRightCorner<3, 3>() =
      (track * covariance.bottomRightCorner<3, 3>() * track.transpose()).eval();
  return covariance;
}

}  // namespace

std::optional<WheelDelta> PreintegrateWheels(Span<const WheelOdometry> odometry, TimeNs start,
                                             TimeNs end,
                                             const WheelPreintegrationOptions& options) {
  options.Check();
  REGOLITH_CHECK(start < end, "from ", start, " to ", end);
  if (odometry.empty() || odometry.front().time > start || odometry.back().time < end) {
    return std::nullopt;
  }
  const auto is_earlier = [](const WheelOdometry& entry, TimeNs time) { return entry.time < time; };
  const WheelOdometry* first =
      std::lower_bound(odometry.begin(), odometry.end(), start, is_earlier);
  const WheelOdometry* last = std::lower_bound(first, odometry.end(), end, is_earlier);

  WheelDelta delta;
  delta.start_time = start;
  delta.end_time = end;
  const SE3 T_odom_from = PoseAt(odometry, first, start);
  const SE3 T_odom_to = PoseAt(odometry, last, end);
  SE3 previous = T_odom_from;
  for (const WheelOdometry* entry = first; entry != last; ++entry) {
    AddStep(previous, entry->T_odom_base, &delta);
    previous = entry->T_odom_base;
  }
  AddStep(previous, T_odom_to, &delta);
  delta.T_from_to = T_odom_from.Inverse() * T_odom_to;
  delta.covariance = Covariance(delta, options);
  return delta;
}

}  // namespace regolith
