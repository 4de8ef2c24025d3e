// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/core/time.h"
#include "regolith/geometry/se3.h"

namespace regolith {

/// Where every frame is known to have been: keyframes until they leave the window, others as they
/// stood to the keyframe before them.
class FrameHistory {
 public:
  /// Its number.
  size_t Add(TimeNs time, const SE3& T_world_imu) {
    records_.push_back({time, T_world_imu, kSelf, SE3()});
    return records_.size() - 1;
  }

  void Move(size_t frame, const SE3& T_world_imu) { records_[frame].T_world_imu = T_world_imu; }

  /// From now on the frame follows another.
  void Attach(size_t frame, size_t keyframe, const SE3& T_keyframe_frame) {
    records_[frame].keyframe = keyframe;
    records_[frame].T_keyframe_frame = T_keyframe_frame;
  }

  SE3 Pose(size_t frame) const {
    const Record& record = records_[frame];
    if (record.keyframe == kSelf) return record.T_world_imu;
    return records_[record.keyframe].T_world_imu * record.T_keyframe_frame;
  }
  TimeNs Time(size_t frame) const { return records_[frame].time; }
  size_t size() const { return records_.size(); }

 private:
  static constexpr size_t kSelf = static_cast<size_t>(-1);

  struct Record {
    TimeNs time = 0;
    SE3 T_world_imu;
    size_t keyframe = kSelf;  ///< that it follows
    SE3 T_keyframe_frame;
  };

  std::vector<Record> records_;
};

}  // namespace regolith
