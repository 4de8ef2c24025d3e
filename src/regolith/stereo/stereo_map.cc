// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/stereo_map.h"

#include <algorithm>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/features/descriptor_similarity.h"

namespace regolith {
namespace {

/// The rows of `values` that are kept.
template <typename Value>
std::vector<Value> Kept(const std::vector<Value>& values, const std::vector<size_t>& rows) {
  std::vector<Value> kept;
  kept.reserve(rows.size());
  for (const size_t row : rows) kept.push_back(values[row]);
  return kept;
}

}  // namespace

StereoLandmark* StereoMap::Find(LandmarkId landmark) {
  const auto found = landmarks_.find(landmark);
  return found == landmarks_.end() ? nullptr : &found->second;
}

const StereoLandmark* StereoMap::Find(LandmarkId landmark) const {
  const auto found = landmarks_.find(landmark);
  return found == landmarks_.end() ? nullptr : &found->second;
}

StereoKeyframe& StereoMap::AddKeyframe(StereoKeyframe keyframe) {
  REGOLITH_CHECK(keyframe.landmarks.size() == keyframe.features.size(), keyframe.landmarks.size(),
                 " of ", keyframe.features.size());
  keyframe.id = next_keyframe_++;
  StereoKeyframe& added = keyframes_.emplace(keyframe.id, std::move(keyframe)).first->second;
  for (size_t i = 0; i < added.landmarks.size(); ++i) {
    StereoLandmark* landmark = Find(added.landmarks[i]);
    if (landmark == nullptr) {
      added.landmarks[i] = kNoId;
    } else {
      landmark->sightings.push_back({added.id, static_cast<int32_t>(i)});
    }
  }
  for (const LandmarkId landmark : added.landmarks) {
    if (landmark != kNoId) Refresh(landmark);
  }
  return added;
}

LandmarkId StereoMap::AddLandmark(const Eigen::Vector3d& position_world, KeyframeId keyframe,
                                  size_t feature) {
  StereoKeyframe& seeing = keyframes_.at(keyframe);
  REGOLITH_CHECK(seeing.landmarks[feature] == kNoId, "feature ", feature, " has a landmark");
  const LandmarkId id = next_landmark_++;
  StereoLandmark& landmark = landmarks_[id];
  landmark.position_world = position_world;
  landmark.first_keyframe = keyframe;
  landmark.sightings.push_back({keyframe, static_cast<int32_t>(feature)});
  seeing.landmarks[feature] = id;
  Refresh(id);
  return id;
}

bool StereoMap::AddSighting(LandmarkId landmark, KeyframeId keyframe, size_t feature) {
  StereoLandmark& seen = landmarks_.at(landmark);
  LandmarkId& slot = keyframes_.at(keyframe).landmarks[feature];
  if (slot != kNoId) return false;
  for (const StereoSighting& sighting : seen.sightings) {
    if (sighting.keyframe == keyframe) return false;
  }
  slot = landmark;
  const StereoSighting added{keyframe, static_cast<int32_t>(feature)};
  const auto place =
      std::upper_bound(seen.sightings.begin(), seen.sightings.end(), added,
                       [](const auto& a, const auto& b) { return a.keyframe < b.keyframe; });
  seen.sightings.insert(place, added);
  return true;
}

void StereoMap::RemoveSighting(LandmarkId landmark, KeyframeId keyframe) {
  StereoLandmark& seen = landmarks_.at(landmark);
  for (auto sighting = seen.sightings.begin(); sighting != seen.sightings.end(); ++sighting) {
    if (sighting->keyframe != keyframe) continue;
    keyframes_.at(keyframe).landmarks[static_cast<size_t>(sighting->feature)] = kNoId;
    seen.sightings.erase(sighting);
    break;
  }
  if (seen.sightings.empty()) {
    landmarks_.erase(landmark);
  } else if (seen.typical.keyframe == keyframe) {
    Refresh(landmark);
  }
}

void StereoMap::RemoveLandmark(LandmarkId landmark) {
  for (const StereoSighting& sighting : landmarks_.at(landmark).sightings) {
    keyframes_.at(sighting.keyframe).landmarks[static_cast<size_t>(sighting.feature)] = kNoId;
  }
  landmarks_.erase(landmark);
}

void StereoMap::Merge(LandmarkId kept, LandmarkId gone) {
  if (kept == gone) return;
  const StereoLandmark removed = landmarks_.at(gone);
  RemoveLandmark(gone);
  for (const StereoSighting& sighting : removed.sightings) {
    AddSighting(kept, sighting.keyframe, static_cast<size_t>(sighting.feature));
  }
  StereoLandmark& merged = landmarks_.at(kept);
  merged.expected += removed.expected;
  merged.found += removed.found;
  Refresh(kept);
}

void StereoMap::RemoveKeyframe(KeyframeId keyframe) {
  StereoKeyframe& removed = keyframes_.at(keyframe);
  REGOLITH_CHECK(removed.parent != kNoId, "keyframe ", keyframe, " is the first");
  removed_[keyframe] = {removed.parent, Pose(removed.parent).Inverse() * removed.T_world_camera};
  const std::vector<LandmarkId> landmarks = removed.landmarks;
  for (const LandmarkId landmark : landmarks) {
    if (landmark != kNoId) RemoveSighting(landmark, keyframe);
  }
  keyframes_.erase(keyframe);
}

void StereoMap::Slim(KeyframeId keyframe) {
  StereoKeyframe& slim = keyframes_.at(keyframe);
  if (slim.is_slim) return;
  slim.is_slim = true;
  std::vector<size_t> rows;
  for (size_t i = 0; i < slim.landmarks.size(); ++i) {
    if (slim.landmarks[i] != kNoId) rows.push_back(i);
  }
  for (size_t row = 0; row < rows.size(); ++row) {
    for (StereoSighting& sighting : landmarks_.at(slim.landmarks[rows[row]]).sightings) {
      if (sighting.keyframe == keyframe) sighting.feature = static_cast<int32_t>(row);
    }
    StereoSighting& typical = landmarks_.at(slim.landmarks[rows[row]]).typical;
    if (typical.keyframe == keyframe) typical.feature = static_cast<int32_t>(row);
  }
  StereoFeatures& features = slim.features;
  features.pixels = Kept(features.pixels, rows);
  features.right_columns = Kept(features.right_columns, rows);
  features.scales = Kept(features.scales, rows);
  if (!features.patches.empty()) features.patches = Kept(features.patches, rows);
  if (!features.slopes.empty()) features.slopes = Kept(features.slopes, rows);
  Descriptors descriptors;
  descriptors.ResetLike(features.descriptors);
  for (const size_t row : rows) descriptors.Append(features.descriptors, row);
  features.descriptors = std::move(descriptors);
  slim.landmarks = Kept(slim.landmarks, rows);
}

void StereoMap::Refresh(LandmarkId id) {
  StereoLandmark& landmark = landmarks_.at(id);
  Eigen::Vector3d view = Eigen::Vector3d::Zero();
  for (const StereoSighting& sighting : landmark.sightings) {
    view += (landmark.position_world - keyframes_.at(sighting.keyframe).T_world_camera.translation)
                .normalized();
  }
  if (view.norm() > 0.0) landmark.view_world = view.normalized();
  float best = -1e9F;
  for (const StereoSighting& one : landmark.sightings) {
    float sum = 0.0F;
    for (const StereoSighting& other : landmark.sightings) {
      sum += DescriptorSimilarity(
          keyframes_.at(one.keyframe).features.descriptors, static_cast<size_t>(one.feature),
          keyframes_.at(other.keyframe).features.descriptors, static_cast<size_t>(other.feature));
    }
    if (sum <= best) continue;
    best = sum;
    landmark.typical = one;
  }
  const StereoKeyframe& typical = keyframes_.at(landmark.typical.keyframe);
  landmark.scale_distance = typical.features.scales[static_cast<size_t>(landmark.typical.feature)] *
                            (landmark.position_world - typical.T_world_camera.translation).norm();
}

SE3 StereoMap::Pose(KeyframeId keyframe) const {
  const auto found = keyframes_.find(keyframe);
  if (found != keyframes_.end()) return found->second.T_world_camera;
  const Removed& removed = removed_.at(keyframe);
  return Pose(removed.parent) * removed.T_parent_camera;
}

std::vector<Covisible> StereoMap::Seeing(const std::vector<LandmarkId>& landmarks) const {
  std::map<KeyframeId, int> counts;
  for (const LandmarkId id : landmarks) {
    const StereoLandmark* landmark = id == kNoId ? nullptr : Find(id);
    if (landmark == nullptr) continue;
    for (const StereoSighting& sighting : landmark->sightings) ++counts[sighting.keyframe];
  }
  std::vector<Covisible> seeing;
  for (const auto& [keyframe, shared] : counts) seeing.push_back({keyframe, shared});
  // Of equal ones the newer first.
  std::sort(seeing.begin(), seeing.end(), [](const Covisible& a, const Covisible& b) {
    return a.shared != b.shared ? a.shared > b.shared : a.keyframe > b.keyframe;
  });
  return seeing;
}

std::vector<Covisible> StereoMap::CovisibleWith(KeyframeId keyframe) const {
  std::vector<Covisible> seeing = Seeing(keyframes_.at(keyframe).landmarks);
  seeing.erase(std::remove_if(seeing.begin(), seeing.end(),
                              [&](const Covisible& one) { return one.keyframe == keyframe; }),
               seeing.end());
  return seeing;
}

PointSighting StereoMap::SightingOf(const StereoLandmark& landmark, const StereoSighting& sighting,
                                    const SightingNoise& noise) const {
  return regolith::SightingOf(keyframes_.at(sighting.keyframe).features,
                              static_cast<size_t>(sighting.feature), landmark.position_world,
                              noise);
}

}  // namespace regolith
