// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regolith/backend/backend.h"
#include "regolith/backend/keyframe_selector.h"
#include "regolith/core/thread_pool.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/lio/scan_odometry.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"
#include "regolith/system/frame_report.h"
#include "regolith/system/keyframe_sight.h"
#include "regolith/system/map_builder.h"
#include "regolith/system/pipeline_options.h"

namespace regolith {

/// The lidar's side of a pipeline: a scan odometry, the map, and the keyframes for the back end.
/// Where scans stay away, it goes on at their rate with what IMU, wheels and camera tell.
class LidarPart {
 public:
  using KeyframeSink = std::function<void(KeyframeInput, std::optional<KeyframeSight>)>;

  /// `keyframes` is called for every keyframe, in order; may be empty. The rig has what
  /// `options.odometry` needs.
  LidarPart(const PipelineOptions& options, const RigCalibration& rig, ThreadPool* threads,
            KeyframeSink keyframes);

  /// From now on keyframes come with what the camera saw, and need its images to be processed too.
  void CollectSights(const std::string& camera, double scan_distance) {
    sights_.emplace(camera, scan_distance);
  }

  /// What other subsystems tell, before the measurement at its time.
  void AddVelocity(const BodyVelocity& velocity) { odometry_->AddVelocity(velocity); }
  std::vector<FrameReport> Process(const SensorEvent& event);
  std::vector<FrameReport> Finish();

  /// Estimates since the last call, for those that learn from them.
  std::vector<std::shared_ptr<const ScanEstimate>> TakeEstimates() {
    return std::exchange(estimates_, {});
  }

  /// Poses as first put out.
  const Trajectory& trajectory() const { return trajectory_; }
  /// The odometry's own better knowledge, where it has loops of its own.
  std::optional<Trajectory> Refined() const { return odometry_->Refined(); }
  const MapBuilder& map() const { return map_; }
  /// Scans, and times without them at which a pose was asked for.
  size_t stamps() const { return scans_ + asked_; }
  KeyframeCounts Counts() const { return odometry_->Counts(); }
  std::vector<std::string> Notices() const;

 private:
  std::vector<FrameReport> Report(std::vector<ScanEstimate> estimates);
  std::vector<FrameReport> BridgeSilence(TimeNs now);
  std::optional<size_t> SendKeyframe(const ScanEstimate& estimate);

  std::unique_ptr<ScanOdometry> odometry_;
  KeyframeSink keyframes_;
  KeyframeSelector selector_;
  std::optional<SightCollector> sights_;
  size_t keyframe_count_ = 0;
  MapBuilder map_;
  Trajectory trajectory_;
  std::vector<std::shared_ptr<const ScanEstimate>> estimates_;
  double period_;   ///< s, of scans
  double silence_;  ///< s without a scan, after which poses are asked for
  std::optional<TimeNs> last_stamp_;
  size_t scans_ = 0;
  size_t asked_ = 0;
};

}  // namespace regolith
