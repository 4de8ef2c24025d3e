// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/core/stopwatch.h"
#include "regolith/core/time.h"
#include "regolith/features/descriptor_matcher.h"
#include "regolith/features/feature_extractor.h"
#include "regolith/features/feature_options.h"
#include "regolith/features/feature_set.h"
#include "regolith/features/model_manifest.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sensor/image.h"

namespace regolith {

struct TrackedFeature {
  int64_t id = 0;  ///< of the track, for ever its own
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  ///< unit, camera frame
  Eigen::Vector2d velocity =
      Eigen::Vector2d::Zero();  ///< pixels/s since the frame before; 0 for a new or recovered track
  float score = 0.0F;           ///< of the detection; LK: of the first
  int age = 1;                  ///< frames in which it was seen
  bool recovered = false;       ///< was lost and found again in this frame
};

struct FrontendStatus {
  int detected = 0;   ///< keypoints of the extractor; 0 where it was not asked
  int tracked = 0;    ///< tracks of the frame before that were found
  int recovered = 0;  ///< tracks lost earlier that were found
  int rejected = 0;   ///< matches that outlier rejection removed
  int started = 0;    ///< new tracks
  double mean_age = 0.0;
  DetectionStatus detection;
};

struct TrackedFrame {
  TimeNs time = 0;
  std::vector<TrackedFeature> features;  ///< in order of their ids
  Descriptors descriptors;               ///< row i of features[i]; empty for st_lk
  FrontendStatus status;
  std::vector<StageTime> stages;
};

/// One image and what is known beforehand.
struct FrontendInput {
  TimeNs time = 0;
  const Image* image = nullptr;
  const Image* mask =
      nullptr;  ///< as large as the image, 0 where features are not wanted (the rover's parts)
  /// Rotation of the camera since the frame before: this camera frame into the earlier one.
  std::optional<Eigen::Quaterniond> R_previous_current;
};

/// Two images matched without memory.
struct PairMatches {
  FeatureSet first;
  FeatureSet second;
  std::vector<FeatureMatch> matches;
  std::vector<uint8_t> inliers;  ///< one a match
  const char* rejection_model = "none";
  int looked_again = 0;  ///< 1 or 2: the image whose keypoints are those of a second look; 0: none
  DetectionStatus first_status;
  DetectionStatus second_status;
  std::vector<StageTime> stages;
};

/// Follows features through the images of one camera: the one interface of all frontends, used by
/// visual–inertial and stereo odometry, loop closure and `regolith match`.
class FeatureFrontend {
 public:
  virtual ~FeatureFrontend() = default;

  /// The features of the next image of the stream.
  virtual TrackedFrame Track(const FrontendInput& input) = 0;

  /// Matches two images, apart from the stream.
  virtual PairMatches MatchPair(const Image& first, const Image& second) = 0;

  /// Forgets all tracks and thresholds; ids go on.
  virtual void Reset() = 0;

  /// The frontend of options.frontend. `camera`, which must outlive it, may be null: bearings are
  /// then (0, 0, 1) and outliers are rejected by the fundamental matrix. Networks need their
  /// manifest.
  static std::unique_ptr<FeatureFrontend> Create(const FeatureOptions& options,
                                                 const CameraModel* camera,
                                                 const std::optional<ModelManifest>& manifest);
};

}  // namespace regolith
