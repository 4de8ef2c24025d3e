// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/stereo_pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

/// s, by which the two images of a pair may differ.
constexpr double kPairTime = 0.005;
/// Periods of the camera between two images that poses are interpolated over: two may be missing.
constexpr double kMaxPeriods = 3.5;
/// m of way that a turn of one rad counts as, in the odometry's drift.
constexpr double kTurnWay = 0.3;

SE3 LeftRight(const RigCalibration& rig, const std::string& left, const std::string& right) {
  return rig.cameras.at(left).T_imu_camera.Inverse() * rig.cameras.at(right).T_imu_camera;
}

/// The back end's own search for loops needs a lidar.
BackendOptions WithoutLidar(BackendOptions options) {
  options.close_loops = false;
  return options;
}

}  // namespace

StereoPipeline::StereoPipeline(const PipelineOptions& options, const RigCalibration& rig,
                               const std::string& right_camera, const std::optional<Image>& mask,
                               ThreadPool* threads)
    : left_camera_(options.tracked_camera),
      right_camera_(right_camera),
      max_gap_(kMaxPeriods / rig.cameras.at(left_camera_).rate),
      frontend_(options.features, options.feature_model, options.stereo,
                rig.cameras.at(left_camera_).intrinsics, rig.cameras.at(right_camera).intrinsics,
                LeftRight(rig, left_camera_, right_camera), mask, threads),
      T_body_camera_(rig.cameras.at(left_camera_).T_imu_camera * frontend_.T_left_rectified()),
      odometry_(options.stereo, frontend_.camera(), T_body_camera_),
      options_(options.stereo),
      selector_(options.backend.keyframes) {
  if (!options.backend.enabled || !options.backend.close_loops) return;
  backend_ = std::make_unique<Backend>(WithoutLidar(options.backend), threads);
  places_ = std::make_unique<VisualPlaces>(options.places);
}

std::vector<StereoReport> StereoPipeline::AddImage(const CameraFrame& frame) {
  std::vector<StereoReport> reports;
  if (frame.camera == right_camera_) {
    waiting_right_ = frame;
  } else if (frame.camera == left_camera_) {
    ++images_seen_;
    if (waiting_left_) reports.push_back(Unpaired(*waiting_left_));
    waiting_left_ = frame;
  }
  if (!waiting_left_ || !waiting_right_ ||
      std::abs(SecondsBetween(waiting_left_->time, waiting_right_->time)) > kPairTime) {
    return reports;
  }
  reports.push_back(Process(*waiting_left_, *waiting_right_));
  waiting_left_.reset();
  waiting_right_.reset();
  return reports;
}

void StereoPipeline::AddStamp(TimeNs time) {
  has_stamps_ = true;
  stamps_.push_back(time);
}

std::vector<StereoReport> StereoPipeline::Finish() {
  std::vector<StereoReport> reports;
  if (waiting_left_) reports.push_back(Unpaired(*waiting_left_));
  waiting_left_.reset();
  CloseLoops(true);
  return reports;
}

StereoReport StereoPipeline::Unpaired(const CameraFrame& left) {
  ++pairs_missed_;
  StereoReport report;
  report.estimate.stamp = left.time;
  report.estimate.health = StereoHealth::kNoPair;
  return report;
}

StereoReport StereoPipeline::Process(const CameraFrame& left, const CameraFrame& right) {
  StereoObservation observation = frontend_.Observe(left.image, right.image);
  StereoReport report;
  report.stages = std::move(observation.stages);
  report.features.detected = observation.left_keypoints;
  report.features.detection = observation.detection;
  report.estimate = odometry_.Process(left.time, std::move(observation.features));
  StereoEstimate& estimate = report.estimate;
  for (const StageTime& stage : estimate.stages) report.stages.push_back(stage);
  report.features.tracked = estimate.tracking.inliers;
  report.features.rejected = estimate.tracking.outliers;
  if (estimate.health == StereoHealth::kLost) ++pairs_lost_;
  if (estimate.health == StereoHealth::kNotStarted) ++pairs_before_start_;
  if (estimate.T_world_camera) report.T_world_body = BodyPose(*estimate.T_world_camera);
  AnswerStamps(estimate);
  Stopwatch stopwatch;
  if (estimate.is_keyframe && backend_) {
    CloseLoops(false);
    stopwatch.Lap("loops");
    for (const StageTime& stage : stopwatch.stages()) report.stages.push_back(stage);
  }
  return report;
}

/// Poses between two images that both have one.
void StereoPipeline::AnswerStamps(const StereoEstimate& estimate) {
  const bool is_tracked = estimate.T_world_camera.has_value();
  const bool goes_on = is_tracked && last_ && last_->T_world_camera &&
                       SecondsBetween(last_->stamp, estimate.stamp) <= max_gap_;
  for (; !stamps_.empty() && stamps_.front() <= estimate.stamp; stamps_.pop_front()) {
    const TimeNs stamp = stamps_.front();
    if (is_tracked && stamp == estimate.stamp) {
      at_scans_.poses.Append({stamp, BodyPose(*estimate.T_world_camera)});
      at_scans_.anchors.push_back({estimate.frame, estimate.frame, 1.0});
    } else if (goes_on && stamp >= last_->stamp) {
      const double share =
          SecondsBetween(last_->stamp, stamp) / SecondsBetween(last_->stamp, estimate.stamp);
      at_scans_.poses.Append({stamp, Interpolate(BodyPose(*last_->T_world_camera),
                                                 BodyPose(*estimate.T_world_camera), share)});
      at_scans_.anchors.push_back({last_->frame, estimate.frame, share});
    }
  }
  if (is_tracked) {
    at_images_.poses.Append({estimate.stamp, BodyPose(*estimate.T_world_camera)});
    at_images_.anchors.push_back({estimate.frame, estimate.frame, 1.0});
  }
  last_ = estimate;
}

Trajectory StereoPipeline::Refined() const {
  const AnchoredPoses& wanted = Wanted();
  Trajectory refined;
  for (size_t i = 0; i < wanted.anchors.size(); ++i) {
    const Anchor& anchor = wanted.anchors[i];
    refined.Append({wanted.poses.poses()[i].time,
                    Interpolate(BodyPose(odometry_.Refined(anchor.before)),
                                BodyPose(odometry_.Refined(anchor.after)), anchor.share)});
  }
  return backend_ ? backend_->Corrected(refined) : refined;
}

void StereoPipeline::CloseLoops(bool all) {
  if (!backend_) return;
  for (StereoPlace& place : odometry_.TakePlaces(all)) AddPlace(std::move(place));
}

void StereoPipeline::AddPlace(StereoPlace place) {
  const SE3 T_odom_body = BodyPose(place.T_world_camera);
  if (!selector_.Select(place.stamp, T_odom_body)) return;
  const SE3 step = drift_.T_a_b.Inverse() * T_odom_body;
  const double way = step.translation.norm() + kTurnWay * LogSo3(step.rotation).norm();
  UncertainPose moved{step, Matrix6d::Zero()};
  moved.covariance.diagonal().head<3>().setConstant(std::pow(options_.drift_rotation, 2) * way);
  moved.covariance.diagonal().tail<3>().setConstant(std::pow(options_.drift_position, 2) * way);
  drift_ = Compose(drift_, moved);
  KeyframeInput input;
  input.time = place.stamp;
  input.T_odom_body = T_odom_body;
  input.covariance = ExpToPlusCovariance(drift_.covariance, T_odom_body);
  backend_->Add(input);

  const KeyframeStore& keyframes = backend_->keyframes();
  places_->Add(keyframes.size() - 1,
               {std::move(place.global), std::move(place.descriptors), std::move(place.bearings),
                std::move(place.ranges), T_body_camera_});
  const size_t end = EndOfOld(keyframes, backend_->options().search);
  for (const LoopMeasurement& loop : places_->Confirmed(end)) backend_->AddLoop(loop);
}

std::vector<MapPoint> StereoPipeline::MapPoints() const {
  const StereoMap& map = odometry_.map();
  Trajectory keyframes;
  for (const auto& [id, keyframe] : map.keyframes()) {
    keyframes.Append({keyframe.stamp, BodyPose(keyframe.T_world_camera)});
  }
  const Trajectory corrected = backend_ ? backend_->Corrected(keyframes) : keyframes;
  std::vector<MapPoint> points;
  size_t index = 0;
  for (const auto& [id, keyframe] : map.keyframes()) {
    const SE3 correction =
        corrected.poses()[index].T_world_body * keyframes.poses()[index].T_world_body.Inverse();
    ++index;
    for (const LandmarkId landmark_id : keyframe.landmarks) {
      if (landmark_id == kNoId) continue;
      const StereoLandmark& landmark = *map.Find(landmark_id);
      if (landmark.sightings.front().keyframe != id) continue;
      points.push_back({(correction * landmark.position_world).cast<float>(), 0.0F});
    }
  }
  return points;
}

KeyframeCounts StereoPipeline::Counts() const {
  KeyframeCounts counts;
  counts.keyframes = odometry_.keyframes_made();
  if (backend_) {
    counts.loops_accepted = backend_->loops_accepted();
    counts.loops_rejected = backend_->loops_rejected();
  }
  return counts;
}

std::vector<std::string> StereoPipeline::Notices() const {
  std::vector<std::string> notices;
  if (pairs_missed_ > 0) {
    notices.push_back(Concatenate(pairs_missed_, " of ", images_seen_,
                                  " images of the left camera had no right one within ", kPairTime,
                                  " s and have no pose; check the stereo pair's stamps"));
  }
  if (pairs_before_start_ > 0) {
    notices.push_back(Concatenate(
        pairs_before_start_, " stereo pairs came before the start: fewer than ",
        options_.min_start_points,
        " keypoints with a distance; check that both eyes see, and the rig's T_imu_camera"));
  }
  if (pairs_lost_ > 0) {
    notices.push_back(Concatenate("lost ", odometry_.losses(), " times: ", pairs_lost_,
                                  " stereo pairs have no pose"));
  }
  return notices;
}

}  // namespace regolith
