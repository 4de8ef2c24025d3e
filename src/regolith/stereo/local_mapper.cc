// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/local_mapper.h"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>

#include "regolith/stereo/local_adjustment.h"

namespace regolith {
namespace {

constexpr size_t kFarNeighbours = 4;
constexpr size_t kFusedNeighbours = 8;
constexpr double kFuseRadius = 3.0;  // pixels, times the scale
constexpr double kFarRadius = 6.0;   // pixels, times the scale: the distance is hardly known
constexpr KeyframeId kTrial = 3;     // keyframes, after which a landmark is kept for good
constexpr KeyframeId kYoung = 2;     // keyframes, that are not redundant yet
constexpr int kSeenElsewhere = 3;    // keyframes, that see a landmark of a redundant one
constexpr int kPointIterations = 5;
constexpr double kNearest = 0.1;  // m

/// Least squares of where a point lies that several keyframes see.
Eigen::Vector3d RefinePoint(const RectifiedCamera& camera, const std::vector<SE3>& T_camera_world,
                            const std::vector<PointSighting>& sightings,
                            Eigen::Vector3d point_world) {
  for (int i = 0; i < kPointIterations; ++i) {
    Eigen::Matrix3d information = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (size_t k = 0; k < sightings.size(); ++k) {
      const Eigen::Vector3d point = T_camera_world[k] * point_world;
      if (point.z() < kNearest) return point_world;
      const Eigen::Matrix3d whitening = sightings[k].Whitening();
      const Eigen::Vector3d error = whitening * (camera.Project(point) - sightings[k].seen);
      const Eigen::Matrix3d jacobian = whitening * camera.ProjectionJacobian(point) *
                                       T_camera_world[k].rotation.toRotationMatrix();
      information += jacobian.transpose() * jacobian;
      gradient += jacobian.transpose() * error;
    }
    const Eigen::Vector3d step = -information.ldlt().solve(gradient);
    if (!step.allFinite()) return point_world;
    point_world += step;
  }
  return point_world;
}

}  // namespace

LocalMapper::LocalMapper(const StereoOptions& options, StereoMap* map)
    : options_(options),
      map_(map),
      search_(options.search, map->camera()),
      aligner_(options.alignment, map->camera()),
      close_depth_(options.close_baselines * map->camera().baseline) {}

KeyframeId LocalMapper::Insert(KeyframeId reference, StereoFrame* frame) {
  StereoKeyframe keyframe;
  keyframe.stamp = frame->stamp;
  keyframe.T_world_camera = frame->T_world_camera;
  keyframe.features = frame->features;
  keyframe.landmarks = frame->landmarks;
  keyframe.landmarks.resize(frame->features.size(), kNoId);
  keyframe.parent = reference;
  if (!keyframe.features.patches.empty()) {
    keyframe.features.slopes = DisparitySlopes(keyframe.features);
  }
  const KeyframeId id = map_->AddKeyframe(std::move(keyframe)).id;
  RemovePoorLandmarks(id);
  AddPointsOf(id);
  if (reference != kNoId) {
    AddFarPoints(id);
    FuseAround(id);
    AdjustAround(id, options_.adjustment, options_.noise, map_);
    RemoveRedundant(id);
    const KeyframeId old = id - options_.full_keyframes;
    if (map_->HasKeyframe(old)) map_->Slim(old);
  }
  frame->T_world_camera = map_->keyframe(id).T_world_camera;
  frame->landmarks = map_->keyframe(id).landmarks;
  return id;
}

/// Close points, or the nearest ones where there are few (Mur-Artal & Tardós 2017, section III-E).
void LocalMapper::AddPointsOf(KeyframeId id) {
  const StereoKeyframe& keyframe = map_->keyframe(id);
  std::vector<std::pair<double, size_t>> points;  // depth, feature
  for (size_t i = 0; i < keyframe.features.size(); ++i) {
    if (keyframe.features.HasRight(i)) {
      points.emplace_back(keyframe.features.Depth(i, map_->camera()), i);
    }
  }
  std::sort(points.begin(), points.end());
  for (size_t rank = 0; rank < points.size(); ++rank) {
    const auto& [depth, feature] = points[rank];
    if (depth >= close_depth_ && rank >= static_cast<size_t>(options_.min_new_points)) break;
    if (keyframe.landmarks[feature] != kNoId) continue;
    on_trial_.push_back(map_->AddLandmark(
        keyframe.T_world_camera * keyframe.features.Point(feature, map_->camera()), id, feature));
  }
}

/// A landmark has to be found in a share of the images that should see it, and in a second keyframe
/// (Mur-Artal et al. 2015, section VI-B).
void LocalMapper::RemovePoorLandmarks(KeyframeId newest) {
  std::vector<LandmarkId> remaining;
  for (const LandmarkId id : on_trial_) {
    const StereoLandmark* landmark = map_->Find(id);
    if (landmark == nullptr) continue;
    const KeyframeId age = newest - landmark->first_keyframe;
    const bool is_rare = landmark->found < options_.min_found_share * landmark->expected;
    if (is_rare || (age >= kTrial && landmark->sightings.size() < 2)) {
      map_->RemoveLandmark(id);
    } else if (age < kTrial) {
      remaining.push_back(id);
    }
  }
  on_trial_ = std::move(remaining);
}

bool LocalMapper::Fits(KeyframeId keyframe, size_t feature,
                       const Eigen::Vector3d& point_world) const {
  const StereoKeyframe& seeing = map_->keyframe(keyframe);
  const PointSighting sighting = SightingOf(seeing.features, feature, point_world, options_.noise);
  return SquaredError(map_->camera(), seeing.T_world_camera.Inverse(), sighting) <=
         OutlierThreshold(sighting.has_right);
}

/// Far points are known well enough where a second keyframe sees them.
void LocalMapper::AddFarPoints(KeyframeId newest) {
  const std::vector<Covisible> covisible = map_->CovisibleWith(newest);
  for (size_t i = 0; i < std::min(covisible.size(), kFarNeighbours); ++i) {
    if (!map_->keyframe(covisible[i].keyframe).is_slim) {
      AddFarPointsWith(newest, covisible[i].keyframe);
    }
  }
}

void LocalMapper::AddFarPointsWith(KeyframeId newest, KeyframeId neighbour_id) {
  const RectifiedCamera& camera = map_->camera();
  const StereoKeyframe& keyframe = map_->keyframe(newest);
  StereoKeyframe& neighbour = map_->keyframe(neighbour_id);
  const SE3 T_neighbour_world = neighbour.T_world_camera.Inverse();
  const SE3 T_keyframe_world = keyframe.T_world_camera.Inverse();
  std::vector<SearchPoint> points;
  for (size_t i = 0; i < keyframe.features.size(); ++i) {
    if (keyframe.landmarks[i] != kNoId || !keyframe.features.HasRight(i)) continue;
    const Eigen::Vector3d point_neighbour =
        T_neighbour_world * (keyframe.T_world_camera * keyframe.features.Point(i, camera));
    if (point_neighbour.z() < kNearest) continue;
    const Eigen::Vector3d predicted = camera.Project(point_neighbour);
    if (!camera.Contains(predicted.head<2>())) continue;
    points.push_back(FeatureAsPoint(keyframe.features, i, predicted, kFarRadius));
  }
  for (const FeatureMatch& match : search_.ByPlace(points, neighbour.features, true)) {
    const size_t feature = points[static_cast<size_t>(match.first)].row;
    const auto other = static_cast<size_t>(match.second);
    if (neighbour.landmarks[other] != kNoId || keyframe.landmarks[feature] != kNoId) continue;
    if (!aligner_.Align(keyframe, feature,
                        keyframe.T_world_camera * keyframe.features.Point(feature, camera),
                        neighbour.T_world_camera, &neighbour.features, other)) {
      continue;
    }
    const std::vector<PointSighting> sightings = {
        SightingOf(keyframe.features, feature, {}, options_.noise),
        SightingOf(neighbour.features, other, {}, options_.noise)};
    const Eigen::Vector3d position =
        RefinePoint(camera, {T_keyframe_world, T_neighbour_world}, sightings,
                    keyframe.T_world_camera * keyframe.features.Point(feature, camera));
    if (!Fits(newest, feature, position) || !Fits(neighbour_id, other, position)) continue;
    const LandmarkId id = map_->AddLandmark(position, newest, feature);
    map_->AddSighting(id, neighbour_id, other);
    map_->Refresh(id);
    on_trial_.push_back(id);
  }
}

void LocalMapper::FuseAround(KeyframeId newest) {
  const std::vector<Covisible> covisible = map_->CovisibleWith(newest);
  for (size_t i = 0; i < std::min(covisible.size(), kFusedNeighbours); ++i) {
    FuseInto(newest, covisible[i].keyframe);
  }
}

/// The keyframe's landmarks are looked for in a neighbour: found anew, or as another landmark of
/// the same point.
void LocalMapper::FuseInto(KeyframeId newest, KeyframeId neighbour_id) {
  const StereoKeyframe& keyframe = map_->keyframe(newest);
  StereoKeyframe& neighbour = map_->keyframe(neighbour_id);
  std::vector<SearchPoint> points;
  std::vector<LandmarkId> searched;
  for (const LandmarkId id : keyframe.landmarks) {
    if (id == kNoId) continue;
    const StereoLandmark& landmark = *map_->Find(id);
    const bool is_seen =
        std::any_of(landmark.sightings.begin(), landmark.sightings.end(),
                    [&](const StereoSighting& one) { return one.keyframe == neighbour_id; });
    if (is_seen) continue;
    const auto point = search_.Predict(*map_, landmark, neighbour.T_world_camera, kFuseRadius);
    if (!point) continue;
    points.push_back(*point);
    searched.push_back(id);
  }
  for (const FeatureMatch& match : search_.ByPlace(points, neighbour.features, false)) {
    const LandmarkId id = searched[static_cast<size_t>(match.first)];
    const auto feature = static_cast<size_t>(match.second);
    const StereoLandmark* landmark = map_->Find(id);
    if (landmark == nullptr) continue;
    const LandmarkId there = neighbour.landmarks[feature];
    if (there == kNoId &&
        !aligner_.Align(*map_, *landmark, neighbour.T_world_camera, &neighbour.features, feature)) {
      continue;
    }
    if (!Fits(neighbour_id, feature, landmark->position_world)) continue;
    if (there == kNoId) {
      if (map_->AddSighting(id, neighbour_id, feature)) map_->Refresh(id);
      continue;
    }
    const StereoLandmark& other = *map_->Find(there);
    if (ShareKeyframe(*landmark, other)) continue;
    const bool keeps_other = other.sightings.size() > landmark->sightings.size();
    map_->Merge(keeps_other ? there : id, keeps_other ? id : there);
  }
}

/// Two landmarks that one keyframe sees apart are two points.
bool LocalMapper::ShareKeyframe(const StereoLandmark& first, const StereoLandmark& second) const {
  for (const StereoSighting& one : first.sightings) {
    for (const StereoSighting& other : second.sightings) {
      if (one.keyframe == other.keyframe) return true;
    }
  }
  return false;
}

/// Nine in ten of its close landmarks are seen as well by three others (Mur-Artal et al. 2015,
/// section VI-E).
bool LocalMapper::IsRedundant(const StereoKeyframe& keyframe) const {
  int close = 0;
  int elsewhere = 0;
  for (size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    if (keyframe.landmarks[i] == kNoId || !keyframe.features.HasRight(i) ||
        keyframe.features.Depth(i, map_->camera()) >= close_depth_) {
      continue;
    }
    ++close;
    int others = 0;
    for (const StereoSighting& sighting : map_->Find(keyframe.landmarks[i])->sightings) {
      if (sighting.keyframe == keyframe.id) continue;
      const float scale =
          map_->keyframe(sighting.keyframe).features.scales[static_cast<size_t>(sighting.feature)];
      if (scale <= 1.3F * keyframe.features.scales[i]) ++others;
    }
    if (others >= kSeenElsewhere) ++elsewhere;
  }
  return close > 0 && elsewhere > options_.redundant_share * close;
}

void LocalMapper::RemoveRedundant(KeyframeId newest) {
  for (const Covisible& one : map_->CovisibleWith(newest)) {
    const StereoKeyframe& keyframe = map_->keyframe(one.keyframe);
    if (keyframe.parent == kNoId || keyframe.id + kYoung > newest) continue;
    if (!IsRedundant(keyframe)) continue;
    removed_.push_back(one.keyframe);
    map_->RemoveKeyframe(one.keyframe);
  }
}

}  // namespace regolith
