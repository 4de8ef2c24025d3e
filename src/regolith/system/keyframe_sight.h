// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "regolith/geometry/trajectory.h"
#include "regolith/lio/scan_odometry.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// What a camera saw last before a keyframe, and the ground that the lidar has seen since the
/// keyframe before.
struct KeyframeSight {
  std::shared_ptr<const CameraFrame> frame;
  SE3 T_odom_body;  ///< when the image was taken
  std::vector<std::shared_ptr<const ScanEstimate>> scans;
};

/// Brings images and scans of a pipeline together for its keyframes.
class SightCollector {
 public:
  /// `camera`: the images of others are left aside. `scan_distance`: m between scans that are kept.
  SightCollector(std::string camera, double scan_distance)
      : camera_(std::move(camera)), scan_distance_(scan_distance) {}

  void AddImage(const CameraFrame& frame);
  void AddEstimate(const std::shared_ptr<const ScanEstimate>& estimate);
  /// Of the last estimate, which is a keyframe. Nothing where no image was taken since the estimate
  /// before.
  std::optional<KeyframeSight> Take();

 private:
  std::string camera_;
  double scan_distance_;
  std::deque<std::shared_ptr<const CameraFrame>> frames_;
  std::vector<std::shared_ptr<const ScanEstimate>> scans_;
  std::shared_ptr<const ScanEstimate> last_scan_;  ///< of those that were kept
  std::optional<StampedPose> before_;              ///< of the last two estimates
  std::optional<StampedPose> last_;
};

}  // namespace regolith
