// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/time.h"
#include "regolith/geometry/se3.h"
#include "regolith/sensor/rectified_camera.h"
#include "regolith/stereo/pose_solver.h"
#include "regolith/stereo/stereo_features.h"

namespace regolith {

using KeyframeId = int64_t;
using LandmarkId = int64_t;
inline constexpr int64_t kNoId = -1;

/// A keyframe that sees a landmark, and which of its features that is.
struct StereoSighting {
  KeyframeId keyframe = kNoId;
  int32_t feature = 0;
};

/// A point of the ground.
struct StereoLandmark {
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();  ///< m
  std::vector<StereoSighting> sightings;                     ///< in order of their keyframes
  StereoSighting typical;  ///< whose descriptor is most like those of the others
  Eigen::Vector3d view_world = Eigen::Vector3d::UnitZ();  ///< unit, mean, from the cameras to it
  double scale_distance = 0.0;  ///< m: scale of the feature · distance, the same from everywhere
  int expected = 1;             ///< images that should have seen it …
  int found = 1;                ///< … and did
  KeyframeId first_keyframe = kNoId;
};

/// A pair of images that stands for those around it.
struct StereoKeyframe {
  KeyframeId id = kNoId;
  TimeNs stamp = 0;
  SE3 T_world_camera;
  StereoFeatures features;
  std::vector<LandmarkId> landmarks;  ///< one a feature; kNoId: none
  KeyframeId parent = kNoId;          ///< an older one that sees much of the same
  bool is_slim = false;               ///< holds only features with landmarks
};

/// A keyframe that sees the same landmarks, and how many of them.
struct Covisible {
  KeyframeId keyframe = kNoId;
  int shared = 0;
};

/// Keyframes and landmarks that see and are seen (covisibility: Mur-Artal et al. 2015, section
/// III-D). What is removed leaves no trace, but for the pose of a keyframe, which is kept from its
/// parent's.
class StereoMap {
 public:
  explicit StereoMap(const RectifiedCamera& camera) : camera_(camera) {}

  const RectifiedCamera& camera() const { return camera_; }

  /// Landmarks named in it gain a sighting. Its id is given here; ids increase.
  StereoKeyframe& AddKeyframe(StereoKeyframe keyframe);
  /// A landmark at a feature with none.
  LandmarkId AddLandmark(const Eigen::Vector3d& position_world, KeyframeId keyframe,
                         size_t feature);
  /// Nothing is done where the keyframe sees the landmark already, or another there.
  bool AddSighting(LandmarkId landmark, KeyframeId keyframe, size_t feature);
  /// A landmark without sightings is removed.
  void RemoveSighting(LandmarkId landmark, KeyframeId keyframe);
  void RemoveLandmark(LandmarkId landmark);
  /// The sightings of `gone` become those of `kept`.
  void Merge(LandmarkId kept, LandmarkId gone);
  /// Its landmarks lose a sighting; its pose is that of its parent from now on.
  void RemoveKeyframe(KeyframeId keyframe);
  /// Forgets the features without landmarks.
  void Slim(KeyframeId keyframe);

  /// View, scale and typical descriptor, of the sightings as they are now.
  void Refresh(LandmarkId landmark);

  bool HasKeyframe(KeyframeId keyframe) const { return keyframes_.count(keyframe) > 0; }
  StereoKeyframe& keyframe(KeyframeId id) { return keyframes_.at(id); }
  const StereoKeyframe& keyframe(KeyframeId id) const { return keyframes_.at(id); }
  const std::map<KeyframeId, StereoKeyframe>& keyframes() const { return keyframes_; }
  /// Null where it is gone.
  StereoLandmark* Find(LandmarkId landmark);
  const StereoLandmark* Find(LandmarkId landmark) const;
  size_t landmark_count() const { return landmarks_.size(); }

  /// T_world_camera, also of a keyframe that was removed.
  SE3 Pose(KeyframeId keyframe) const;

  /// The keyframes that see some of these landmarks, those that see most first.
  std::vector<Covisible> Seeing(const std::vector<LandmarkId>& landmarks) const;
  /// The same of a keyframe's landmarks, without itself.
  std::vector<Covisible> CovisibleWith(KeyframeId keyframe) const;

  /// What a keyframe saw of a landmark.
  PointSighting SightingOf(const StereoLandmark& landmark, const StereoSighting& sighting,
                           const SightingNoise& noise) const;

 private:
  struct Removed {
    KeyframeId parent = kNoId;
    SE3 T_parent_camera;
  };

  RectifiedCamera camera_;
  std::map<KeyframeId, StereoKeyframe> keyframes_;
  std::unordered_map<LandmarkId, StereoLandmark> landmarks_;  ///< never walked through: no order
  std::map<KeyframeId, Removed> removed_;
  KeyframeId next_keyframe_ = 0;
  LandmarkId next_landmark_ = 0;
};

}  // namespace regolith
