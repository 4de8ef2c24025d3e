// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/features/feature_frontend.h"
#include "regolith/features/flow_field.h"
#include "regolith/features/keypoint_grid.h"
#include "regolith/features/track_geometry.h"
#include "regolith/features/track_memory.h"

namespace regolith {

/// A place in the current image with the descriptor that goes with it.
struct Observation {
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();
  const Descriptors* descriptors = nullptr;
  size_t row = 0;  ///< of the descriptors; unused where they are of type kNone
};

/// The tracks of a camera's stream, for every kind of frontend. A frame is worked off in the order
/// of the functions: Begin, Continue for each track found, EndContinuing, Recover, RememberUnseen,
/// Resume and Start for what is added, Finish.
class TrackStream {
 public:
  TrackStream(const FeatureOptions& options, const CameraModel* camera);

  /// Takes the next image. Where its time is not later than the last, or its size another, all
  /// tracks end and it counts as a first image; false then and for the first.
  bool Begin(const FrontendInput& input);

  /// The tracks of the frame before, where they are looked for, and their descriptors.
  const std::vector<TrackedFeature>& tracks() const { return tracks_; }
  const std::vector<Eigen::Vector2f>& predicted() const { return predicted_; }
  const Descriptors& descriptors() const { return descriptors_; }
  const std::optional<Eigen::Quaterniond>& R_current_previous() const {
    return R_current_previous_;
  }
  const TrackGeometry& geometry() const { return geometry_; }
  const KeypointGrid& grid() const { return grid_; }
  /// Pixels of the current frame's features so far.
  const std::vector<Eigen::Vector2f>& pixels() const { return pixels_; }

  /// Which correspondences with the frame before agree with one motion of the camera.
  std::vector<uint8_t> Inliers(const Correspondences& matches,
                               const OutlierRejectionOptions& options) const;
  void Continue(size_t track, const Observation& observation);
  /// The flow of what was found moves the places of what is lost.
  void EndContinuing();
  /// Lost tracks among keypoints that no track claims.
  void Recover(const std::vector<Eigen::Vector2f>& pixels, const Descriptors& descriptors,
               std::vector<RecoveredTrack>* recovered);
  /// Tracks that were not continued count as lost from here on. `forget`, where not empty, is 1 for
  /// those that are not worth it.
  void RememberUnseen(const std::vector<uint8_t>& forget);
  void Resume(const TrackedFeature& lost, const Observation& observation);
  void Start(float score, const Observation& observation);
  /// Fills everything but stages, `detected` and `rejected`. The cells of `detection` are counted
  /// anew: those that hold a feature.
  void Finish(const DetectionStatus& detection, TrackedFrame* frame);

  void Reset();

 private:
  void Append(const TrackedFeature& feature, const Observation& observation);

  TrackGeometry geometry_;
  int cell_size_;
  TrackMemory memory_;
  int64_t next_id_ = 0;

  bool has_last_ = false;
  TimeNs last_time_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<TrackedFeature> tracks_;
  Descriptors descriptors_;

  KeypointGrid grid_;
  double seconds_ = 0.0;  ///< since the frame before
  std::optional<Eigen::Quaterniond> R_current_previous_;
  std::vector<Eigen::Vector2f> predicted_;
  std::vector<uint8_t> seen_;
  FlowField flow_;
  std::vector<Eigen::Vector2f> flow_pixels_;
  std::vector<Eigen::Vector2f> flows_;

  FrontendStatus status_;
  std::vector<TrackedFeature> features_;  ///< of the current frame, in order of arrival
  std::vector<Eigen::Vector2f> pixels_;
  Descriptors feature_descriptors_;
  std::vector<size_t> order_;
};

/// Leaves the inliers of `items`, one a row of the correspondences; says how many were not.
template <typename Item>
int KeepInliers(const std::vector<uint8_t>& inliers, std::vector<Item>* items) {
  size_t kept = 0;
  for (size_t i = 0; i < items->size(); ++i) {
    if (inliers[i] != 0) (*items)[kept++] = (*items)[i];
  }
  const int rejected = static_cast<int>(items->size() - kept);
  items->resize(kept);
  return rejected;
}

/// Ends a pair whose matches are found: says which of them are inliers, and adds the stages "match"
/// (since `stopwatch` was made) and "reject".
void FinishPair(const Correspondences& matched, const TrackGeometry& geometry,
                const OutlierRejectionOptions& options, Stopwatch* stopwatch, PairMatches* pair);

/// The extractor's stages under `prefix`_STAGE, or `milliseconds` under `prefix` where it names
/// none.
void AppendStages(const std::string& prefix, const FeatureExtractor& extractor, double milliseconds,
                  std::vector<StageTime>* stages);

}  // namespace regolith
