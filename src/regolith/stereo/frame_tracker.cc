// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/frame_tracker.h"

#include <algorithm>
#include <utility>

#include "regolith/features/absolute_pose.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

// Keyframes around a frame: those that share landmarks with it, their own neighbours, and those
// that stood near and looked the same way, so that ground is known again after a round.
constexpr size_t kSharingKeyframes = 20;
constexpr size_t kNeighboursOfEach = 5;
constexpr size_t kLocalKeyframes = 40;
constexpr size_t kNearKeyframes = 10;  // beyond these
constexpr double kNearDistance = 2.0;  // m
constexpr double kNearAngle = 0.6;     // rad
constexpr int kLeastKeyframeMatches = 15;
constexpr int kLeastKeyframeInliers = 10;
constexpr double kPoseError = 4.0;  // pixels, of an inlier of RANSAC
constexpr int kPoseIterations = 200;

}  // namespace

FrameTracker::FrameTracker(const StereoOptions& options, StereoMap* map)
    : options_(options),
      map_(map),
      search_(options.search, map->camera()),
      aligner_(options.alignment, map->camera()),
      detected_(options.noise),
      close_depth_(options.close_baselines * map->camera().baseline) {
  detected_.aligned_pixel = detected_.pixel;
}

bool FrameTracker::FollowFrame(const StereoFrame& last, StereoFrame* frame) {
  return SearchAround(last, options_.search.frame_radius, frame) ||
         SearchAround(last, 2.0 * options_.search.frame_radius, frame);
}

bool FrameTracker::SearchAround(const StereoFrame& last, double radius, StereoFrame* frame) {
  const RectifiedCamera& camera = map_->camera();
  const SE3 T_camera_world = frame->T_world_camera.Inverse();
  std::vector<SearchPoint> points;
  std::vector<Eigen::Vector3d> positions;  // world
  std::vector<LandmarkId> landmarks;
  for (size_t i = 0; i < last.features.size(); ++i) {
    const StereoLandmark* landmark = map_->Find(last.landmarks[i]);
    const bool is_close =
        last.features.HasRight(i) && last.features.Depth(i, camera) < close_depth_;
    if (landmark == nullptr && !is_close) continue;
    const Eigen::Vector3d position = landmark != nullptr
                                         ? landmark->position_world
                                         : last.T_world_camera * last.features.Point(i, camera);
    const Eigen::Vector3d point_camera = T_camera_world * position;
    if (point_camera.z() <= 0.0) continue;
    const Eigen::Vector3d predicted = camera.Project(point_camera);
    if (!camera.Contains(predicted.head<2>())) continue;
    points.push_back(FeatureAsPoint(last.features, i, predicted, radius));
    positions.push_back(position);
    landmarks.push_back(landmark != nullptr ? last.landmarks[i] : kNoId);
  }
  const std::vector<FeatureMatch> matches = search_.ByPlace(points, frame->features, true);
  if (matches.size() < static_cast<size_t>(options_.min_matches)) return false;
  std::vector<PointSighting> sightings;
  for (const FeatureMatch& match : matches) {
    sightings.push_back(SightingOf(frame->features, static_cast<size_t>(match.second),
                                   positions[static_cast<size_t>(match.first)], detected_));
  }
  const PoseSolution solution = SolvePose(camera, sightings, frame->T_world_camera);
  if (solution.inlier_count < static_cast<size_t>(options_.min_matches)) return false;
  frame->T_world_camera = solution.T_world_camera;
  frame->landmarks.assign(frame->features.size(), kNoId);
  for (size_t i = 0; i < matches.size(); ++i) {
    if (solution.inliers[i] == 0) continue;
    frame->landmarks[static_cast<size_t>(matches[i].second)] =
        landmarks[static_cast<size_t>(matches[i].first)];
  }
  return true;
}

bool FrameTracker::FollowKeyframe(KeyframeId keyframe_id, StereoFrame* frame) {
  const StereoKeyframe& keyframe = map_->keyframe(keyframe_id);
  const RectifiedCamera& camera = map_->camera();
  Descriptors descriptors;
  descriptors.ResetLike(keyframe.features.descriptors);
  std::vector<LandmarkId> landmarks;
  for (size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    if (keyframe.landmarks[i] == kNoId) continue;
    descriptors.Append(keyframe.features.descriptors, i);
    landmarks.push_back(keyframe.landmarks[i]);
  }
  const std::vector<FeatureMatch> matches =
      search_.Anywhere(descriptors, frame->features.descriptors);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> bearings;
  for (const FeatureMatch& match : matches) {
    points.push_back(map_->Find(landmarks[static_cast<size_t>(match.first)])->position_world);
    const auto feature = static_cast<size_t>(match.second);
    bearings.push_back(
        camera.PointAt(frame->features.pixels[feature].cast<double>(), 1.0).normalized());
  }
  AbsolutePoseOptions ransac;
  ransac.iterations = kPoseIterations;
  ransac.angle_error = kPoseError / camera.focal;
  ransac.min_inliers = kLeastKeyframeMatches;
  const auto found = EstimateAbsolutePose(points, bearings, ransac);
  if (!found) return false;
  std::vector<PointSighting> sightings;
  for (const int inlier : found->inliers) {
    const auto row = static_cast<size_t>(inlier);
    sightings.push_back(SightingOf(frame->features, static_cast<size_t>(matches[row].second),
                                   points[row], detected_));
  }
  const PoseSolution solution = SolvePose(camera, sightings, found->T_camera_points.Inverse());
  if (solution.inlier_count < kLeastKeyframeInliers) return false;
  frame->T_world_camera = solution.T_world_camera;
  frame->landmarks.assign(frame->features.size(), kNoId);
  for (size_t i = 0; i < sightings.size(); ++i) {
    if (solution.inliers[i] == 0) continue;
    const FeatureMatch& match = matches[static_cast<size_t>(found->inliers[i])];
    frame->landmarks[static_cast<size_t>(match.second)] =
        landmarks[static_cast<size_t>(match.first)];
  }
  return true;
}

void FrameTracker::AddNear(const SE3& T_world_camera, std::vector<KeyframeId>* keyframes) const {
  std::vector<std::pair<double, KeyframeId>> near;  // m
  for (const auto& [id, keyframe] : map_->keyframes()) {
    if (std::find(keyframes->begin(), keyframes->end(), id) != keyframes->end()) continue;
    const double distance =
        (keyframe.T_world_camera.translation - T_world_camera.translation).norm();
    if (distance > kNearDistance ||
        AngleBetween(keyframe.T_world_camera.rotation, T_world_camera.rotation) > kNearAngle) {
      continue;
    }
    near.emplace_back(distance, id);
  }
  std::sort(near.begin(), near.end());
  if (near.size() > kNearKeyframes) near.resize(kNearKeyframes);
  for (const auto& [distance, id] : near) keyframes->push_back(id);
}

std::vector<LandmarkId> FrameTracker::LocalLandmarks(const StereoFrame& frame) const {
  std::vector<Covisible> sharing = map_->Seeing(frame.landmarks);
  if (sharing.size() > kSharingKeyframes) sharing.resize(kSharingKeyframes);
  std::vector<KeyframeId> keyframes;
  const auto add = [&](KeyframeId keyframe) {
    if (keyframes.size() >= kLocalKeyframes) return;
    if (std::find(keyframes.begin(), keyframes.end(), keyframe) == keyframes.end()) {
      keyframes.push_back(keyframe);
    }
  };
  for (const Covisible& one : sharing) add(one.keyframe);
  for (const Covisible& one : sharing) {
    if (keyframes.size() >= kLocalKeyframes) break;
    const std::vector<Covisible> neighbours = map_->CovisibleWith(one.keyframe);
    for (size_t i = 0; i < std::min(neighbours.size(), kNeighboursOfEach); ++i) {
      add(neighbours[i].keyframe);
    }
  }
  AddNear(frame.T_world_camera, &keyframes);
  std::vector<LandmarkId> landmarks;
  for (const KeyframeId keyframe : keyframes) {
    for (const LandmarkId landmark : map_->keyframe(keyframe).landmarks) {
      if (landmark != kNoId) landmarks.push_back(landmark);
    }
  }
  std::sort(landmarks.begin(), landmarks.end());
  landmarks.erase(std::unique(landmarks.begin(), landmarks.end()), landmarks.end());
  return landmarks;
}

void FrameTracker::AddLandmarks(double radius, StereoFrame* frame) {
  std::vector<LandmarkId> known = frame->landmarks;
  std::sort(known.begin(), known.end());
  std::vector<SearchPoint> points;
  std::vector<LandmarkId> searched;
  for (const LandmarkId id : LocalLandmarks(*frame)) {
    StereoLandmark* landmark = map_->Find(id);
    const auto point = search_.Predict(*map_, *landmark, frame->T_world_camera, radius);
    if (!point) continue;
    ++landmark->expected;
    if (std::binary_search(known.begin(), known.end(), id)) continue;
    points.push_back(*point);
    searched.push_back(id);
  }
  for (const FeatureMatch& match : search_.ByPlace(points, frame->features, false)) {
    LandmarkId& slot = frame->landmarks[static_cast<size_t>(match.second)];
    if (slot == kNoId) slot = searched[static_cast<size_t>(match.first)];
  }
}

void FrameTracker::AlignKeypoints(StereoFrame* frame) const {
  for (size_t i = 0; i < frame->landmarks.size(); ++i) {
    const StereoLandmark* landmark = map_->Find(frame->landmarks[i]);
    if (landmark == nullptr) continue;
    if (!aligner_.Align(*map_, *landmark, frame->T_world_camera, &frame->features, i)) {
      frame->landmarks[i] = kNoId;
    }
  }
}

TrackingResult FrameTracker::Judge(StereoFrame* frame) {
  std::vector<PointSighting> sightings;
  std::vector<size_t> rows;
  for (size_t i = 0; i < frame->landmarks.size(); ++i) {
    const StereoLandmark* landmark = map_->Find(frame->landmarks[i]);
    if (landmark == nullptr) {
      frame->landmarks[i] = kNoId;
      continue;
    }
    sightings.push_back(SightingOf(frame->features, i, landmark->position_world, options_.noise));
    rows.push_back(i);
  }
  const PoseSolution solution = SolvePose(map_->camera(), sightings, frame->T_world_camera);
  frame->T_world_camera = solution.T_world_camera;
  TrackingResult result;
  result.inliers = static_cast<int>(solution.inlier_count);
  result.outliers = static_cast<int>(sightings.size()) - result.inliers;
  for (size_t i = 0; i < rows.size(); ++i) {
    LandmarkId& slot = frame->landmarks[rows[i]];
    if (solution.inliers[i] == 0) {
      slot = kNoId;
    } else {
      ++map_->Find(slot)->found;
    }
  }
  for (size_t i = 0; i < frame->features.size(); ++i) {
    if (!frame->features.HasRight(i) || frame->features.Depth(i, map_->camera()) >= close_depth_) {
      continue;
    }
    ++(frame->landmarks[i] == kNoId ? result.close_free : result.close_tracked);
  }
  return result;
}

std::optional<TrackingResult> FrameTracker::FollowMap(double radius, int min_inliers,
                                                      StereoFrame* frame) {
  const StereoFrame before = *frame;
  AddLandmarks(radius, frame);
  AlignKeypoints(frame);
  TrackingResult result = Judge(frame);
  const std::vector<Covisible> seeing = map_->Seeing(frame->landmarks);
  if (result.inliers < min_inliers || seeing.empty()) {
    *frame = before;
    return std::nullopt;
  }
  result.reference = seeing.front().keyframe;
  return result;
}

}  // namespace regolith
