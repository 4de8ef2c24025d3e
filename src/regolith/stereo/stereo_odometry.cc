// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/stereo_odometry.h"

#include <algorithm>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

// A keyframe is not made for landmarks alone where hardly any are left.
constexpr int kLeastForKeyframe = 15;
// Sightings of a landmark of the reference that should be found again; fewer in a map of hardly
// more keyframes.
constexpr size_t kReliableSightings = 3;
constexpr double kMoved = 0.1;       // m
constexpr double kTurned = 0.05;     // rad
constexpr double kCautious = 1.0;    // s after relocalisation
constexpr double kWideRadius = 2.5;  // times the radius, once it was lost
// Keyframes that have to come after one, until its pose hardly changes.
constexpr size_t kSettled = 8;

}  // namespace

const char* StereoHealthName(StereoHealth health) {
  switch (health) {
    case StereoHealth::kGood:
      return "good";
    case StereoHealth::kNotStarted:
      return "not started";
    case StereoHealth::kLost:
      return "lost";
    case StereoHealth::kRelocalised:
      return "relocalised";
    case StereoHealth::kNoPair:
      return "no right image";
  }
  return "";
}

StereoOdometry::StereoOdometry(const StereoOptions& options, const RectifiedCamera& camera,
                               const SE3& T_world_camera)
    : options_(options),
      T_world_start_(T_world_camera),
      map_(camera),
      tracker_(options, &map_),
      mapper_(options, &map_) {
  options_.Check();
}

StereoEstimate StereoOdometry::Process(TimeNs stamp, StereoFeatures features) {
  Stopwatch stopwatch;
  StereoEstimate estimate;
  estimate.stamp = stamp;
  StereoFrame frame;
  frame.stamp = stamp;
  frame.features = std::move(features);
  frame.landmarks.assign(frame.features.size(), kNoId);

  std::optional<TrackingResult> tracking;
  if (state_ == State::kNotStarted) {
    if (!Start(&frame)) return estimate;
    tracking.emplace();
    tracking->reference = reference_;
    estimate.is_keyframe = true;
    estimate.health = StereoHealth::kGood;
  } else {
    if (state_ == State::kTracking) tracking = Track(&frame);
    if (tracking) {
      estimate.health = StereoHealth::kGood;
    } else {
      if (state_ == State::kTracking) ++losses_;
      tracking = Relocalise(&frame);
      if (tracking) relocalised_ = stamp;
      estimate.health = tracking ? StereoHealth::kRelocalised : StereoHealth::kLost;
    }
  }
  stopwatch.Lap("stereo_track");
  if (!tracking) {
    state_ = State::kLost;
    before_last_.reset();
    estimate.stages = stopwatch.stages();
    return estimate;
  }
  reference_ = tracking->reference;
  estimate.T_world_camera = frame.T_world_camera;
  if (!estimate.is_keyframe && WantsKeyframe(*tracking, frame)) {
    InsertKeyframe(reference_, &frame);
    estimate.is_keyframe = true;
    stopwatch.Lap("stereo_map");
  }
  estimate.tracking = *tracking;
  Keep(frame, reference_, &estimate);
  estimate.stages = stopwatch.stages();
  return estimate;
}

bool StereoOdometry::Start(StereoFrame* frame) {
  int points = 0;
  for (size_t i = 0; i < frame->features.size(); ++i) points += frame->features.HasRight(i) ? 1 : 0;
  if (points < options_.min_start_points) return false;
  frame->T_world_camera = T_world_start_;
  InsertKeyframe(kNoId, frame);
  return true;
}

/// The last motion goes on.
SE3 StereoOdometry::Predicted(TimeNs stamp) const {
  if (!before_last_) return last_.T_world_camera;
  const double step = SecondsBetween(before_last_->stamp, last_.stamp);
  const double share = SecondsBetween(last_.stamp, stamp) / step;
  const SE3 motion = before_last_->T_world_camera.Inverse() * last_.T_world_camera;
  return last_.T_world_camera * ExpSe3(share * LogSe3(motion));
}

std::optional<TrackingResult> StereoOdometry::Track(StereoFrame* frame) {
  frame->T_world_camera = Predicted(frame->stamp);
  if (!tracker_.FollowFrame(last_, frame) && !tracker_.FollowKeyframe(reference_, frame)) {
    return std::nullopt;
  }
  const bool is_cautious = relocalised_ && SecondsBetween(*relocalised_, frame->stamp) < kCautious;
  const double radius = options_.search.map_radius;
  return tracker_.FollowMap(is_cautious ? kWideRadius * radius : radius,
                            is_cautious ? options_.min_relocalised : options_.min_inliers, frame);
}

std::optional<TrackingResult> StereoOdometry::Relocalise(StereoFrame* frame) {
  std::vector<KeyframeId> candidates =
      places_.MostSimilar(frame->features.descriptors, options_.place_candidates);
  // Mostly it is where it was.
  candidates.insert(candidates.begin(), reference_);
  for (const KeyframeId candidate : candidates) {
    if (!map_.HasKeyframe(candidate) || !tracker_.FollowKeyframe(candidate, frame)) continue;
    const auto tracking = tracker_.FollowMap(kWideRadius * options_.search.map_radius,
                                             options_.min_relocalised, frame);
    if (tracking) return tracking;
  }
  return std::nullopt;
}

/// Mur-Artal & Tardós 2017, section III-E, with mapping that is always ready.
bool StereoOdometry::WantsKeyframe(const TrackingResult& tracking, const StereoFrame& frame) const {
  const StereoKeyframe& reference = map_.keyframe(tracking.reference);
  const size_t reliable = std::clamp<size_t>(map_.keyframes().size() - 1, 1, kReliableSightings);
  int expected = 0;
  for (const LandmarkId id : reference.landmarks) {
    if (id != kNoId && map_.Find(id)->sightings.size() >= reliable) ++expected;
  }
  const bool lacks_close = tracking.close_tracked < options_.min_close_tracked &&
                           tracking.close_free > options_.min_close_new;
  const bool lacks_landmarks = tracking.inliers < options_.keyframe_share * expected;
  if ((lacks_close || lacks_landmarks) && tracking.inliers > kLeastForKeyframe) return true;
  const StereoKeyframe& newest = map_.keyframes().rbegin()->second;
  if (SecondsBetween(newest.stamp, frame.stamp) < options_.max_keyframe_gap) return false;
  const SE3 moved = newest.T_world_camera.Inverse() * frame.T_world_camera;
  return moved.translation.norm() > kMoved || LogSo3(moved.rotation).norm() > kTurned;
}

void StereoOdometry::InsertKeyframe(KeyframeId reference, StereoFrame* frame) {
  reference_ = mapper_.Insert(reference, frame);
  ++keyframes_made_;
  places_.Add(reference_, map_.keyframe(reference_).features.descriptors);
  for (const KeyframeId removed : mapper_.TakeRemoved()) places_.Remove(removed);
  unsettled_.push_back(reference_);
}

void StereoOdometry::Keep(const StereoFrame& frame, KeyframeId reference,
                          StereoEstimate* estimate) {
  if (state_ == State::kTracking) {
    before_last_ = StereoFrame{last_.stamp, {}, last_.T_world_camera, {}};
  }
  // Where a keyframe has just moved the frame, the one before it moves with it.
  if (before_last_ && estimate->is_keyframe) {
    before_last_->T_world_camera =
        frame.T_world_camera * estimate->T_world_camera->Inverse() * before_last_->T_world_camera;
  }
  last_ = frame;
  state_ = State::kTracking;
  estimate->frame = history_.size();
  history_.push_back({reference, map_.Pose(reference).Inverse() * frame.T_world_camera});
}

SE3 StereoOdometry::Refined(size_t frame) const {
  const FramePose& pose = history_.at(frame);
  return map_.Pose(pose.reference) * pose.T_reference_camera;
}

StereoPlace StereoOdometry::PlaceOf(const StereoKeyframe& keyframe) const {
  StereoPlace place;
  place.keyframe = keyframe.id;
  place.stamp = keyframe.stamp;
  place.T_world_camera = keyframe.T_world_camera;
  place.global = places_.Global(keyframe.id);
  place.descriptors.ResetLike(keyframe.features.descriptors);
  const RectifiedCamera& camera = map_.camera();
  const SE3 T_camera_world = keyframe.T_world_camera.Inverse();
  const double close_depth = options_.close_baselines * camera.baseline;
  for (size_t i = 0; i < keyframe.features.size(); ++i) {
    const StereoLandmark* landmark = map_.Find(keyframe.landmarks[i]);
    const bool is_close =
        keyframe.features.HasRight(i) && keyframe.features.Depth(i, camera) < close_depth;
    if (landmark == nullptr && !is_close) continue;
    const Eigen::Vector3d bearing =
        camera.PointAt(keyframe.features.pixels[i].cast<double>(), 1.0).normalized();
    const Eigen::Vector3d point = landmark != nullptr ? T_camera_world * landmark->position_world
                                                      : keyframe.features.Point(i, camera);
    place.descriptors.Append(keyframe.features.descriptors, i);
    place.bearings.push_back(bearing);
    place.ranges.push_back(point.norm());
  }
  return place;
}

std::vector<StereoPlace> StereoOdometry::TakePlaces(bool all) {
  std::vector<StereoPlace> settled;
  if (!places_.has_vocabulary()) return settled;
  while (!unsettled_.empty() && (all || unsettled_.size() > kSettled)) {
    const KeyframeId keyframe = unsettled_.front();
    unsettled_.pop_front();
    if (map_.HasKeyframe(keyframe)) settled.push_back(PlaceOf(map_.keyframe(keyframe)));
  }
  return settled;
}

}  // namespace regolith
