// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/keyframe_sight.h"

#include <utility>

namespace regolith {
namespace {

/// s that an image is kept for, at most: scans wait for measurements for less.
constexpr double kImageMemory = 1.0;

}  // namespace

void SightCollector::AddImage(const CameraFrame& frame) {
  if (frame.camera != camera_) return;
  frames_.push_back(std::make_shared<const CameraFrame>(frame));
  while (SecondsBetween(frames_.front()->time, frame.time) > kImageMemory) frames_.pop_front();
}

void SightCollector::AddEstimate(const std::shared_ptr<const ScanEstimate>& estimate) {
  before_ = std::exchange(last_, StampedPose{estimate->stamp, estimate->T_world_body});
  while (before_ && !frames_.empty() && frames_.front()->time < before_->time) frames_.pop_front();
  if (!estimate->has_scan) return;
  if (last_scan_ &&
      (estimate->T_world_body.translation - last_scan_->T_world_body.translation).norm() <
          scan_distance_) {
    return;
  }
  last_scan_ = estimate;
  scans_.push_back(estimate);
}

std::optional<KeyframeSight> SightCollector::Take() {
  KeyframeSight sight;
  sight.scans = std::exchange(scans_, {});
  if (!before_) return std::nullopt;
  for (const auto& frame : frames_) {
    if (frame->time <= last_->time) sight.frame = frame;
  }
  if (!sight.frame) return std::nullopt;
  const double share =
      SecondsBetween(before_->time, sight.frame->time) / SecondsBetween(before_->time, last_->time);
  sight.T_odom_body = Interpolate(before_->T_world_body, last_->T_world_body, share);
  return sight;
}

}  // namespace regolith
