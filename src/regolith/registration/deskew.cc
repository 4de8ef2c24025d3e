// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/deskew.h"

#include <algorithm>

#include "regolith/core/check.h"

namespace regolith {
namespace {

/// Interpolates between neighbouring poses; firing times are nearly sorted, so the last place is
/// tried first.
class MotionCursor {
 public:
  explicit MotionCursor(Span<const StampedPose> motion) : motion_(motion) {}

  SE3 At(TimeNs time) {
    while (place_ + 2 < motion_.size() && motion_[place_ + 1].time < time) ++place_;
    while (place_ > 0 && motion_[place_].time > time) --place_;
    if (motion_.size() == 1 || time <= motion_[place_].time) return motion_[place_].T_world_body;
    const StampedPose& before = motion_[place_];
    const StampedPose& after = motion_[place_ + 1];
    const double fraction =
        std::min(1.0, SecondsBetween(before.time, time) / SecondsBetween(before.time, after.time));
    return Interpolate(before.T_world_body, after.T_world_body, fraction);
  }

 private:
  Span<const StampedPose> motion_;
  size_t place_ = 0;
};

}  // namespace

std::vector<Eigen::Vector3d> Deskew(const LidarScan& scan, const SE3& T_body_lidar,
                                    Span<const StampedPose> motion, const SE3& T_fixed_reference) {
  REGOLITH_CHECK(!motion.empty(), "no poses");
  const SE3 T_reference_fixed = T_fixed_reference.Inverse();
  MotionCursor cursor(motion);
  std::vector<Eigen::Vector3d> points;
  points.reserve(scan.points.size());
  // All rings of a firing share a time, and so a transform.
  float transform_time = 0.0F;
  SE3 T_reference_lidar;
  for (const LidarPoint& point : scan.points) {
    if (points.empty() || point.time != transform_time) {
      transform_time = point.time;
      const SE3 T_fixed_body = cursor.At(AddSeconds(scan.stamp, static_cast<double>(point.time)));
      T_reference_lidar = T_reference_fixed * T_fixed_body * T_body_lidar;
    }
    points.push_back(T_reference_lidar * point.position.cast<double>());
  }
  return points;
}

ScanInterval IntervalOf(const LidarScan& scan) {
  if (scan.points.empty()) return {scan.stamp, scan.stamp};
  const auto [first, last] = std::minmax_element(
      scan.points.begin(), scan.points.end(),
      [](const LidarPoint& one, const LidarPoint& other) { return one.time < other.time; });
  return {AddSeconds(scan.stamp, static_cast<double>(first->time)),
          AddSeconds(scan.stamp, static_cast<double>(last->time))};
}

}  // namespace regolith
