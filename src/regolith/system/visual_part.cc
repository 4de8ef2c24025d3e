// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/visual_part.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "regolith/core/error.h"

namespace regolith {
namespace {

constexpr double kLeastBaseline = 0.01;  // m
/// s, by which the two images of a pair may differ.
constexpr double kPairTime = 0.005;
/// s, that the camera's side waits for a first state of the lidar's.
constexpr double kStartWait = 3.0;

}  // namespace

std::string RightCamera(const PipelineOptions& options, const RigCalibration& rig) {
  const std::string asking =
      options.odometry == OdometryKind::kStereo ? "pipeline " + options.name : "vio.stereo";
  const auto left = rig.cameras.find(options.tracked_camera);
  const auto right = rig.cameras.find("right");
  if (left == rig.cameras.end() || right == rig.cameras.end() || left->first != "left") {
    throw InputError(asking,
                     "needs the cameras `left` and `right` in the rig and `tracked_camera: left`; "
                     "with one camera take another pipeline or leave vio.stereo out");
  }
  const double baseline =
      (left->second.T_imu_camera.translation - right->second.T_imu_camera.translation).norm();
  if (baseline < kLeastBaseline) {
    throw InputError(asking, Concatenate("the rig's cameras `left` and `right` are ", baseline,
                                         " m apart, expected at least ", kLeastBaseline,
                                         "; check their T_imu_camera"));
  }
  return right->first;
}

VisualPart::VisualPart(const PipelineOptions& options, const RigCalibration& rig, VisualRole role,
                       std::optional<Image> camera_mask)
    : role_(role),
      tracker_(options, rig, std::move(camera_mask)),
      velocity_sigma_(options.visual_velocity_sigma) {
  if (role == VisualRole::kTracks) return;
  if (options.vio.stereo) {
    right_camera_ = RightCamera(options, rig);
    const CameraCalibration& left = rig.cameras.at(options.tracked_camera);
    const CameraCalibration& right = rig.cameras.at(right_camera_);
    stereo_ = std::make_unique<StereoMatcher>(options.features.optical_flow, right.intrinsics,
                                              left.T_imu_camera.Inverse() * right.T_imu_camera);
  }
  odometry_ = std::make_unique<VisualInertialOdometry>(options.vio, rig, options.tracked_camera,
                                                       right_camera_);
  if (role == VisualRole::kLeads) return;
  odometry_->ExpectStart(kStartWait);
  if (!rig.lidar) return;
  distances_ = std::make_unique<LidarDistances>(options.lidar_depth, rig.lidar->T_imu_lidar);
  odometry_->SetDistanceSource(distances_.get());
}

void VisualPart::AddScanEstimate(const ScanEstimate& estimate) {
  if (estimate.inertial) tracker_.SetGyroBias(estimate.inertial->state.gyro_bias);
  if (!odometry_) return;
  if (distances_ && estimate.has_scan) distances_->AddScan(estimate);
  if (estimate.inertial) {
    odometry_->SetStart(estimate.inertial->state, estimate.inertial->gravity_world);
  }
}

std::vector<FrameReport> VisualPart::Process(const SensorEvent& event) {
  if (const auto* sample = std::get_if<ImuSample>(&event)) {
    tracker_.AddImu(*sample);
    if (odometry_) return Report(odometry_->AddImu(*sample));
  } else if (const auto* wheels = std::get_if<WheelOdometry>(&event)) {
    if (odometry_) odometry_->AddWheels(*wheels);
  } else if (const auto* scan = std::get_if<LidarScan>(&event)) {
    ++scans_;
    if (odometry_) odometry_->AddStamp(scan->stamp);
  } else if (const auto* frame = std::get_if<CameraFrame>(&event)) {
    if (stereo_) return TrackPair(*frame);
    if (frame->camera == tracker_.camera()) return Track(*frame);
  }
  return {};
}

std::vector<FrameReport> VisualPart::Finish() {
  std::vector<FrameReport> reports;
  if (odometry_) reports = Report(odometry_->Finish());
  for (FrameReport& report : tracked_) reports.push_back(std::move(report));
  tracked_.clear();
  return reports;
}

Trajectory VisualPart::Refined() const {
  const FrameHistory history = odometry_->window().History();
  Trajectory refined;
  for (size_t i = 0; i < trajectory_.size(); ++i) {
    refined.Append(
        {trajectory_.poses()[i].time, history.Pose(anchors_[i].frame) * anchors_[i].T_frame_body});
  }
  return refined;
}

std::optional<InertialState> VisualPart::Newest() const {
  if (!odometry_ || !odometry_->is_running()) return std::nullopt;
  const SlidingWindow& window = odometry_->window();
  const auto state = odometry_->StateAt(window.newest().time);
  if (!state) return std::nullopt;
  return InertialState{*state, window.gravity_world()};
}

/// An eye waits for the other; where that does not come, the left goes alone.
std::vector<FrameReport> VisualPart::TrackPair(const CameraFrame& frame) {
  std::vector<FrameReport> reports;
  if (frame.camera == right_camera_) {
    waiting_right_ = frame;
  } else if (frame.camera == tracker_.camera()) {
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

std::vector<FrameReport> VisualPart::Track(const CameraFrame& frame) {
  ++images_;
  TrackedFrame tracked = tracker_.Track(frame.time, frame.image);
  FrameReport report;
  report.source = FrameSource::kImage;
  report.stamp = frame.time;
  report.end = frame.time;
  report.leader = "camera";
  report.features = tracked.status;
  report.stages = std::move(tracked.stages);
  report.completed = std::chrono::steady_clock::now();
  tracks_ = {frame.time, tracked.features};
  if (!odometry_) return {report};
  VioFrame features{frame.time, std::move(tracked.features), {}};
  if (stereo_ && waiting_right_ &&
      std::abs(SecondsBetween(frame.time, waiting_right_->time)) <= kPairTime) {
    Stopwatch stopwatch;
    features.right_bearings = stereo_->Match(frame.image, waiting_right_->image, features.features);
    stopwatch.Lap("features_stereo");
    const auto matched =
        std::count_if(features.right_bearings.begin(), features.right_bearings.end(),
                      [](const auto& bearing) { return bearing.has_value(); });
    ++pairs_seen_;
    if (10 * static_cast<size_t>(matched) < features.features.size()) ++pairs_unmatched_;
    for (const StageTime& stage : stopwatch.stages()) report.stages.push_back(stage);
  }
  tracked_.push_back(std::move(report));
  return Report(odometry_->AddFrame(std::move(features)));
}

std::vector<FrameReport> VisualPart::Report(std::vector<VioEstimate> estimates) {
  KeepPoses(estimates);
  std::vector<FrameReport> reports;
  for (VioEstimate& estimate : estimates) {
    TellVelocity(estimate);
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
    report.end = estimate.state.time;
    report.leader = "camera";
    report.at_rest = estimate.at_rest;
    report.T_world_body = estimate.state.T_world_imu;
    report.covariance = estimate.covariance.topLeftCorner<6, 6>();
    for (const StageTime& stage : estimate.stages) report.stages.push_back(stage);
    report.visual = std::move(estimate);
    report.completed = std::chrono::steady_clock::now();
    reports.push_back(std::move(report));
  }
  if (role_ == VisualRole::kLeads && !estimates.empty()) {
    tracker_.SetGyroBias(odometry_->gyro_bias());
  }
  return reports;
}

/// At scans where there are any, else at images.
void VisualPart::KeepPoses(const std::vector<VioEstimate>& estimates) {
  const auto keep = [this](TimeNs time, const NavState& state, const Anchor& anchor) {
    if (!trajectory_.empty() && time <= trajectory_.poses().back().time) return;
    trajectory_.Append({time, state.T_world_imu});
    anchors_.push_back(anchor);
  };
  for (const StampedState& stamped : odometry_->TakeStamped()) {
    if (distances_) distances_->AddVisual(stamped);
    if (role_ == VisualRole::kLeads) {
      keep(stamped.time, stamped.state, {stamped.frame, stamped.T_frame_imu});
    }
  }
  if (scans_ > 0 || role_ != VisualRole::kLeads) return;
  for (const VioEstimate& estimate : estimates) {
    if (estimate.has_image) keep(estimate.state.time, estimate.state, {estimate.frame, SE3()});
  }
}

void VisualPart::TellVelocity(const VioEstimate& estimate) {
  if (role_ != VisualRole::kHelps || velocity_sigma_ <= 0.0 ||
      estimate.health != VioHealth::kGood) {
    return;
  }
  const NavState& state = estimate.state;
  // What the window knows as of its last keyframe: after a blind time hardly anything, though what
  // it sees since may fit, since standing still looks like driving past ground at infinity.
  const double variance = estimate.covariance.block<3, 3>(6, 6).trace();
  velocities_.push_back({state.time, state.T_world_imu.rotation.conjugate() * state.v_world_imu,
                         std::max(velocity_sigma_, std::sqrt(std::max(variance, 0.0)))});
}

std::vector<std::string> VisualPart::Notices() const {
  if (!odometry_) return {};
  std::vector<std::string> notices = odometry_->Notices();
  if (pairs_missed_ > 0) {
    notices.push_back(Concatenate(pairs_missed_,
                                  " images of the left camera had no right one within ", kPairTime,
                                  " s: they went alone; check the stereo pair's stamps"));
  }
  if (pairs_unmatched_ > 0) {
    notices.push_back(Concatenate("in ", pairs_unmatched_, " of ", pairs_seen_,
                                  " stereo pairs the right image shows less than a tenth of the "
                                  "features: a dark eye, or eyes that are swapped"));
  }
  return notices;
}

}  // namespace regolith
