// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/slam_system.h"

#include "regolith/core/error.h"
#include "regolith/lio/lego_loam.h"
#include "regolith/lio/lidar_odometry.h"

namespace regolith {
namespace {

void CheckLidar(const PipelineOptions& options, const RigCalibration& rig) {
  if (rig.lidar) return;
  throw InputError("pipeline " + options.name,
                   "needs a lidar, but the rig has none; add `lidar:` to the rig file");
}

/// Without the lidar everything hangs on the other two; where one is absent, what would be left is
/// no such pipeline.
void CheckInertialSensors(const PipelineOptions& options, const RigCalibration& rig) {
  if (options.odometry != OdometryKind::kLio || options.lio.lidar) return;
  const char* lacking = !rig.imu ? "imu" : options.lio.wheels && !rig.wheels ? "wheels" : nullptr;
  if (lacking == nullptr) return;
  throw InputError("pipeline " + options.name,
                   Concatenate("does not use the lidar, and the rig has no ", lacking, "; add `",
                               lacking, ":` to the rig file or set lio.lidar=true"));
}

/// Visual–inertial odometry needs both of its sensors; the lidar's stamps say when poses are
/// wanted.
SensorNeeds VisualNeeds(const PipelineOptions& options, const RigCalibration& rig) {
  const char* lacking = nullptr;
  if (!rig.imu) lacking = "imu";
  if (!TracksImages(options, rig)) lacking = "camera that `tracked_camera` names";
  if (lacking != nullptr) {
    throw InputError("pipeline " + options.name,
                     Concatenate("needs an IMU and a camera, and the rig has no ", lacking,
                                 "; add it to the rig file"));
  }
  SensorNeeds needs;
  needs.imu = true;
  needs.lidar = rig.lidar.has_value();
  needs.wheels = options.vio.wheels && rig.wheels.has_value();
  needs.cameras.push_back(options.tracked_camera);
  return needs;
}

SensorNeeds NeedsOf(const PipelineOptions& options, const RigCalibration& rig) {
  if (options.odometry == OdometryKind::kVio) return VisualNeeds(options, rig);
  CheckInertialSensors(options, rig);
  SensorNeeds needs;
  const bool tracks = TracksImages(options, rig);
  const bool is_lio = options.odometry == OdometryKind::kLio;
  needs.imu = is_lio && options.lio.imu && rig.imu.has_value();
  needs.lidar = true;
  needs.wheels = is_lio && options.lio.wheels && rig.wheels.has_value();
  if (tracks) needs.cameras.push_back(options.tracked_camera);
  return needs;
}

std::unique_ptr<ScanOdometry> MakeScanOdometry(const PipelineOptions& options,
                                               const RigCalibration& rig, ThreadPool* threads) {
  if (options.odometry == OdometryKind::kVio) return nullptr;
  CheckLidar(options, rig);
  if (options.odometry == OdometryKind::kLegoLoam) {
    return std::make_unique<LegoLoam>(options.lego_loam, rig, threads);
  }
  return std::make_unique<LidarOdometry>(options.lio, rig, threads);
}

FrameReport ReportOf(const ScanEstimate& estimate) {
  FrameReport report;
  report.stamp = estimate.stamp;
  report.T_world_body = estimate.T_world_body;
  report.leader = estimate.leader;
  report.at_rest = estimate.at_rest;
  report.points = static_cast<int>(estimate.points.size());
  report.matches = estimate.match.system.matches;
  report.inliers = estimate.match.system.inliers;
  report.residual_scale = estimate.match.system.scale;
  report.degenerate_directions = estimate.match.observable.degenerate_directions;
  report.weakest_ratio = estimate.match.observable.weakest_ratio;
  report.weakest_position = estimate.match.observable.weakest_position;
  report.covariance = estimate.covariance;
  report.stages = estimate.stages;
  return report;
}

}  // namespace

bool TracksImages(const PipelineOptions& options, const RigCalibration& rig) {
  return rig.cameras.count(options.tracked_camera) > 0;
}

SlamSystem::SlamSystem(const PipelineOptions& options, const RigCalibration& rig,
                       ThreadPool* threads, std::optional<Image> camera_mask)
    : needs_(NeedsOf(options, rig)),
      scan_odometry_(MakeScanOdometry(options, rig, threads)),
      map_(options.map) {
  if (!needs_.cameras.empty()) {
    tracker_ = std::make_unique<ImageTracker>(options, rig, std::move(camera_mask));
  }
  if (options.odometry == OdometryKind::kVio) {
    visual_ =
        std::make_unique<VisualInertialOdometry>(options.vio, rig, options.tracked_camera, "");
  }
}

std::vector<FrameReport> SlamSystem::Process(const SensorEvent& event) {
  if (const auto* sample = std::get_if<ImuSample>(&event)) {
    if (tracker_) tracker_->AddImu(*sample);
    return visual_ ? Report(visual_->AddImu(*sample)) : Report(scan_odometry_->AddImu(*sample));
  }
  if (const auto* wheels = std::get_if<WheelOdometry>(&event)) {
    if (!visual_) return Report(scan_odometry_->AddWheels(*wheels));
    visual_->AddWheels(*wheels);
    return {};
  }
  if (const auto* frame = std::get_if<CameraFrame>(&event)) {
    if (!tracker_ || frame->camera != tracker_->camera()) return {};
    return Track(*frame);
  }
  if (const auto* scan = std::get_if<LidarScan>(&event)) {
    ++scans_seen_;
    if (!visual_) return Report(scan_odometry_->AddScan(*scan));
    visual_->AddStamp(scan->stamp);
  }
  return {};
}

std::vector<FrameReport> SlamSystem::Finish() {
  return visual_ ? Report(visual_->Finish()) : Report(scan_odometry_->Finish());
}

KeyframeCounts SlamSystem::keyframe_counts() const {
  if (!visual_) return scan_odometry_->Counts();
  KeyframeCounts counts;
  counts.keyframes = visual_->keyframes();
  return counts;
}

std::vector<std::string> SlamSystem::Notices() const {
  return visual_ ? visual_->Notices() : scan_odometry_->Notices();
}

Trajectory SlamSystem::trajectory() const {
  if (!visual_) return scan_odometry_->Refined().value_or(odometry_);
  const FrameHistory history = visual_->window().History();
  Trajectory refined;
  for (size_t i = 0; i < odometry_.size(); ++i) {
    refined.Append(
        {odometry_.poses()[i].time, history.Pose(anchors_[i].frame) * anchors_[i].T_frame_body});
  }
  return refined;
}

std::vector<FrameReport> SlamSystem::Report(std::vector<ScanEstimate> estimates) {
  std::vector<FrameReport> reports;
  for (const ScanEstimate& estimate : estimates) {
    Stopwatch stopwatch;
    odometry_.Append({estimate.stamp, estimate.T_world_body});
    map_.Add(estimate.points, static_cast<uint32_t>(odometry_.size() - 1));
    stopwatch.Lap("output_map");
    reports.push_back(ReportOf(estimate));
    for (const StageTime& stage : stopwatch.stages()) reports.back().stages.push_back(stage);
    if (tracker_ && estimate.gyro_bias) tracker_->SetGyroBias(*estimate.gyro_bias);
  }
  return reports;
}

/// At scans where there are any, else at images.
void SlamSystem::KeepVisualPoses(const std::vector<VioEstimate>& estimates) {
  const auto keep = [this](TimeNs time, const NavState& state, const VisualAnchor& anchor) {
    if (!odometry_.empty() && time <= odometry_.poses().back().time) return;
    odometry_.Append({time, state.T_world_imu});
    anchors_.push_back(anchor);
  };
  for (const StampedState& stamped : visual_->TakeStamped()) {
    keep(stamped.time, stamped.state, {stamped.frame, stamped.T_frame_imu});
  }
  if (scans_seen_ > 0) return;
  for (const VioEstimate& estimate : estimates) {
    if (estimate.has_image) keep(estimate.state.time, estimate.state, {estimate.frame, SE3()});
  }
}

std::vector<FrameReport> SlamSystem::Report(std::vector<VioEstimate> estimates) {
  KeepVisualPoses(estimates);
  std::vector<FrameReport> reports;
  for (VioEstimate& estimate : estimates) {
    FrameReport report;
    // Images that were too near the one before have no estimate.
    while (estimate.has_image && !tracked_.empty() && tracked_.front().stamp <= estimate.stamp) {
      report = std::move(tracked_.front());
      tracked_.pop_front();
    }
    report.source = FrameSource::kImage;
    report.stamp = estimate.stamp;
    report.leader = VioHealthName(estimate.health);
    report.at_rest = estimate.at_rest;
    report.T_world_body = estimate.state.T_world_imu;
    report.covariance = estimate.covariance.topLeftCorner<6, 6>();
    for (const StageTime& stage : estimate.stages) report.stages.push_back(stage);
    report.visual = std::move(estimate);
    reports.push_back(std::move(report));
  }
  if (!estimates.empty()) tracker_->SetGyroBias(visual_->gyro_bias());
  return reports;
}

std::vector<MapPoint> SlamSystem::MapPoints() const {
  if (!scan_odometry_) return {};
  const std::optional<Trajectory> refined = scan_odometry_->Refined();
  if (!refined) return map_.points();
  std::vector<SE3> corrections;
  for (size_t i = 0; i < odometry_.size(); ++i) {
    corrections.push_back(refined->poses()[i].T_world_body *
                          odometry_.poses()[i].T_world_body.Inverse());
  }
  return map_.Moved(corrections);
}

std::vector<FrameReport> SlamSystem::Track(const CameraFrame& frame) {
  ++images_seen_;
  TrackedFrame tracked = tracker_->Track(frame.time, frame.image);
  FrameReport report;
  report.source = FrameSource::kImage;
  report.stamp = frame.time;
  report.leader = "camera";
  report.features = tracked.status;
  report.stages = std::move(tracked.stages);
  if (!visual_) return {report};
  tracked_.push_back(std::move(report));
  return Report(visual_->AddFrame({frame.time, std::move(tracked.features), {}}));
}

}  // namespace regolith
