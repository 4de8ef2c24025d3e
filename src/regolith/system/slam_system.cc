// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/slam_system.h"

#include <cmath>
#include <utility>

#include "regolith/core/error.h"
#include "regolith/lio/lego_loam.h"
#include "regolith/lio/lidar_odometry.h"

namespace regolith {
namespace {

constexpr double kLeastBaseline = 0.01;  // m
/// s, by which the two images of a pair may differ.
constexpr double kPairTime = 0.005;
/// s, that the camera's part waits for a first state of the lidar's.
constexpr double kStartWait = 3.0;

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

/// The other eye of the tracked camera; a pair without a baseline is none.
std::string RightCamera(const PipelineOptions& options, const RigCalibration& rig) {
  const auto left = rig.cameras.find(options.tracked_camera);
  const auto right = rig.cameras.find("right");
  if (left == rig.cameras.end() || right == rig.cameras.end() || left->first != "left") {
    throw InputError("vio.stereo",
                     "needs the cameras `left` and `right` in the rig and `tracked_camera: left`; "
                     "leave it out for one camera");
  }
  const double baseline =
      (left->second.T_imu_camera.translation - right->second.T_imu_camera.translation).norm();
  if (baseline < kLeastBaseline) {
    throw InputError("vio.stereo", Concatenate("the rig's cameras `left` and `right` are ",
                                               baseline, " m apart, expected at least ",
                                               kLeastBaseline, "; check their T_imu_camera"));
  }
  return right->first;
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
  if (options.vio.stereo) needs.cameras.push_back(RightCamera(options, rig));
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

/// LegoLoam has loops of its own; without the lidar nothing confirms them.
bool HasBackend(const PipelineOptions& options) {
  return options.backend.enabled && options.odometry == OdometryKind::kLio && options.lio.lidar;
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
  if (tracks && options.visual && options.vio.stereo) {
    needs.cameras.push_back(RightCamera(options, rig));
  }
  return needs;
}

SlamSystem::SlamSystem(const PipelineOptions& options, const RigCalibration& rig,
                       ThreadPool* threads, std::optional<Image> camera_mask)
    : needs_(NeedsOf(options, rig)),
      scan_odometry_(MakeScanOdometry(options, rig, threads)),
      visual_velocity_sigma_(options.visual_velocity_sigma),
      map_(options.map) {
  if (HasBackend(options)) backend_ = std::make_unique<Backend>(options.backend, threads);
  if (!needs_.cameras.empty()) {
    tracker_ = std::make_unique<ImageTracker>(options, rig, std::move(camera_mask));
  }
  const bool is_visual = options.odometry == OdometryKind::kVio;
  // Beside the lidar's part the camera's needs an IMU and images; without them the other goes
  // alone.
  if (!is_visual && !(options.visual && tracker_ && rig.imu)) return;
  if (options.vio.stereo) {
    right_camera_ = RightCamera(options, rig);
    const CameraCalibration& left = rig.cameras.at(options.tracked_camera);
    const CameraCalibration& right = rig.cameras.at(right_camera_);
    stereo_ = std::make_unique<StereoMatcher>(options.features.optical_flow, right.intrinsics,
                                              left.T_imu_camera.Inverse() * right.T_imu_camera);
  }
  visual_ = std::make_unique<VisualInertialOdometry>(options.vio, rig, options.tracked_camera,
                                                     right_camera_);
  if (is_visual) return;
  visual_->ExpectStart(kStartWait);
  distances_ = std::make_unique<LidarDistances>(options.lidar_depth, rig.lidar->T_imu_lidar);
  visual_->SetDistanceSource(distances_.get());
}

std::vector<FrameReport> SlamSystem::Process(const SensorEvent& event) {
  std::vector<FrameReport> reports;
  const auto take = [&reports](std::vector<FrameReport> more) {
    for (FrameReport& report : more) reports.push_back(std::move(report));
  };
  if (const auto* sample = std::get_if<ImuSample>(&event)) {
    if (tracker_) tracker_->AddImu(*sample);
    if (visual_) take(Report(visual_->AddImu(*sample)));
    if (scan_odometry_) take(Report(scan_odometry_->AddImu(*sample)));
  } else if (const auto* wheels = std::get_if<WheelOdometry>(&event)) {
    if (visual_) visual_->AddWheels(*wheels);
    if (scan_odometry_) take(Report(scan_odometry_->AddWheels(*wheels)));
  } else if (const auto* frame = std::get_if<CameraFrame>(&event)) {
    if (stereo_) {
      take(TrackPair(*frame));
    } else if (tracker_ && frame->camera == tracker_->camera()) {
      take(Track(*frame));
    }
  } else if (const auto* scan = std::get_if<LidarScan>(&event)) {
    ++scans_seen_;
    if (visual_) visual_->AddStamp(scan->stamp);
    if (scan_odometry_) take(Report(scan_odometry_->AddScan(*scan)));
  }
  return reports;
}

std::vector<FrameReport> SlamSystem::Finish() {
  std::vector<FrameReport> reports;
  if (visual_) reports = Report(visual_->Finish());
  for (FrameReport& report : tracked_) reports.push_back(std::move(report));
  tracked_.clear();
  if (!scan_odometry_) return reports;
  for (FrameReport& report : Report(scan_odometry_->Finish())) reports.push_back(std::move(report));
  return reports;
}

KeyframeCounts SlamSystem::keyframe_counts() const {
  if (backend_) {
    return {backend_->keyframes().size(), backend_->loops_accepted(), backend_->loops_rejected()};
  }
  if (scan_odometry_) return scan_odometry_->Counts();
  KeyframeCounts counts;
  counts.keyframes = visual_->keyframes();
  return counts;
}

std::vector<std::string> SlamSystem::Notices() const {
  std::vector<std::string> notices;
  if (scan_odometry_) notices = scan_odometry_->Notices();
  if (!visual_) return notices;
  for (std::string& notice : visual_->Notices()) notices.push_back(std::move(notice));
  if (pairs_missed_ > 0) {
    notices.push_back(Concatenate(pairs_missed_,
                                  " images of the left camera had no right one within ", kPairTime,
                                  " s: they went alone; check the stereo pair's stamps"));
  }
  return notices;
}

Trajectory SlamSystem::trajectory() const {
  if (backend_) return backend_->Corrected(odometry_);
  if (scan_odometry_) return scan_odometry_->Refined().value_or(odometry_);
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
    std::vector<StageTime>& stages = reports.back().stages;
    for (const StageTime& stage : stopwatch.stages()) stages.push_back(stage);
    for (const StageTime& stage : AddKeyframe(estimate)) stages.push_back(stage);
    TellScan(estimate);
  }
  return reports;
}

std::vector<StageTime> SlamSystem::AddKeyframe(const ScanEstimate& estimate) {
  if (!backend_ || !backend_->IsKeyframe(estimate.stamp, estimate.T_world_body)) return {};
  KeyframeInput keyframe;
  keyframe.time = estimate.stamp;
  keyframe.T_odom_body = estimate.T_world_body;
  keyframe.covariance = estimate.covariance;
  keyframe.is_level = estimate.inertial.has_value();
  const SE3 T_body_world = estimate.T_world_body.Inverse();
  keyframe.points_body.reserve(estimate.points.size());
  for (const MapPoint& point : estimate.points) {
    keyframe.points_body.push_back(T_body_world * point.position.cast<double>());
  }
  return backend_->Add(keyframe);
}

/// What the lidar's part knows helps the camera's.
void SlamSystem::TellScan(const ScanEstimate& estimate) {
  if (tracker_ && estimate.inertial) tracker_->SetGyroBias(estimate.inertial->state.gyro_bias);
  if (!distances_) return;
  distances_->AddScan(estimate);
  if (estimate.inertial) {
    visual_->SetStart(estimate.inertial->state, estimate.inertial->gravity_world);
  }
}

/// And the other way round.
void SlamSystem::TellVelocity(const VioEstimate& estimate) {
  if (visual_velocity_sigma_ <= 0.0 || estimate.health != VioHealth::kGood) return;
  const NavState& state = estimate.state;
  scan_odometry_->AddVelocity({state.time,
                               state.T_world_imu.rotation.conjugate() * state.v_world_imu,
                               visual_velocity_sigma_});
}

/// At scans where there are any, else at images.
void SlamSystem::KeepVisualPoses(const std::vector<VioEstimate>& estimates) {
  const auto keep = [this](TimeNs time, const NavState& state, const VisualAnchor& anchor) {
    if (!odometry_.empty() && time <= odometry_.poses().back().time) return;
    odometry_.Append({time, state.T_world_imu});
    anchors_.push_back(anchor);
  };
  for (const StampedState& stamped : visual_->TakeStamped()) {
    if (distances_) {
      distances_->AddVisual(stamped);
    } else {
      keep(stamped.time, stamped.state, {stamped.frame, stamped.T_frame_imu});
    }
  }
  if (scans_seen_ > 0 || distances_) return;
  for (const VioEstimate& estimate : estimates) {
    if (estimate.has_image) keep(estimate.state.time, estimate.state, {estimate.frame, SE3()});
  }
}

std::vector<FrameReport> SlamSystem::Report(std::vector<VioEstimate> estimates) {
  KeepVisualPoses(estimates);
  std::vector<FrameReport> reports;
  for (VioEstimate& estimate : estimates) {
    if (distances_) TellVelocity(estimate);
    FrameReport report;
    // Images from before the start, or too near the one before, have no estimate.
    for (; !tracked_.empty() && tracked_.front().stamp < estimate.stamp; tracked_.pop_front()) {
      reports.push_back(std::move(tracked_.front()));
    }
    if (estimate.has_image && !tracked_.empty() && tracked_.front().stamp == estimate.stamp) {
      report = std::move(tracked_.front());
      tracked_.pop_front();
    }
    report.source = FrameSource::kImage;
    report.stamp = estimate.stamp;
    report.leader = "camera";
    report.at_rest = estimate.at_rest;
    report.T_world_body = estimate.state.T_world_imu;
    report.covariance = estimate.covariance.topLeftCorner<6, 6>();
    for (const StageTime& stage : estimate.stages) report.stages.push_back(stage);
    report.visual = std::move(estimate);
    reports.push_back(std::move(report));
  }
  if (!distances_ && !estimates.empty()) tracker_->SetGyroBias(visual_->gyro_bias());
  return reports;
}

std::vector<MapPoint> SlamSystem::MapPoints() const {
  if (!scan_odometry_) return {};
  if (!backend_ && !scan_odometry_->Refined()) return map_.points();
  const Trajectory best = trajectory();
  std::vector<SE3> corrections;
  for (size_t i = 0; i < odometry_.size(); ++i) {
    corrections.push_back(best.poses()[i].T_world_body *
                          odometry_.poses()[i].T_world_body.Inverse());
  }
  return map_.Moved(corrections);
}

/// An eye waits for the other; where that does not come, the left goes alone.
std::vector<FrameReport> SlamSystem::TrackPair(const CameraFrame& frame) {
  std::vector<FrameReport> reports;
  if (frame.camera == right_camera_) {
    waiting_right_ = frame;
  } else if (frame.camera == tracker_->camera()) {
    if (waiting_left_) {
      ++pairs_missed_;
      reports = Track(*std::exchange(waiting_left_, std::nullopt));
    }
    waiting_left_ = frame;
  }
  if (!waiting_left_ || !waiting_right_ ||
      std::abs(SecondsBetween(waiting_left_->time, waiting_right_->time)) > kPairTime) {
    return reports;
  }
  for (FrameReport& report : Track(*std::exchange(waiting_left_, std::nullopt))) {
    reports.push_back(std::move(report));
  }
  waiting_right_.reset();
  return reports;
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
  tracks_ = {frame.time, tracked.features};
  if (!visual_) return {report};
  VioFrame features{frame.time, std::move(tracked.features), {}};
  if (stereo_ && waiting_right_ &&
      std::abs(SecondsBetween(frame.time, waiting_right_->time)) <= kPairTime) {
    Stopwatch stopwatch;
    features.right_bearings = stereo_->Match(frame.image, waiting_right_->image, features.features);
    stopwatch.Lap("features_stereo");
    for (const StageTime& stage : stopwatch.stages()) report.stages.push_back(stage);
  }
  tracked_.push_back(std::move(report));
  return Report(visual_->AddFrame(std::move(features)));
}

}  // namespace regolith
