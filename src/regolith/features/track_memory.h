// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/features/descriptor_matcher.h"
#include "regolith/features/feature_frontend.h"
#include "regolith/features/flow_field.h"
#include "regolith/features/track_geometry.h"

namespace regolith {

/// A track that the last frames did not see.
struct LostTrack {
  TrackedFeature feature;  ///< pixel and bearing: where it is thought to be in the last frame
  int frames_lost = 0;
};

/// A keypoint that is a lost track again.
struct RecoveredTrack {
  TrackedFeature feature;  ///< as when it was lost
  int keypoint = 0;        ///< row of the keypoints asked with
};

/// Moves a feature that the current frame does not show to where it is thought to be: with the
/// camera's rotation and the flow around it. False where it leaves what the lens can see.
bool MoveUnseen(const TrackGeometry& geometry,
                const std::optional<Eigen::Quaterniond>& R_current_previous, const FlowField& flow,
                TrackedFeature* feature);

/// Remembers lost tracks by their descriptors for some frames, moves the places where they are
/// looked for with the camera's rotation and the flow around them, and finds them again.
class TrackMemory {
 public:
  /// At most `capacity` tracks are remembered, the longest first.
  TrackMemory(const TrackMemoryOptions& options, const DescriptorMatcherOptions& matcher,
              int capacity);

  void Clear();

  /// A frame has passed: forgets what is too old and moves the rest.
  void Advance(const TrackGeometry& geometry,
               const std::optional<Eigen::Quaterniond>& R_current_previous, const FlowField& flow);

  /// The lost tracks among the keypoints, in order of the keypoints; they are lost no longer.
  void Recover(Span<const Eigen::Vector2f> pixels, const Descriptors& descriptors,
               std::vector<RecoveredTrack>* recovered);

  /// Remembers a track that the current frame does not see, at the place where it is thought to be.
  void Add(const TrackedFeature& feature, const Descriptors& descriptors, size_t row);
  /// Ends the frame: forgets what exceeds the capacity.
  void Trim();

  const std::vector<LostTrack>& tracks() const { return tracks_; }

 private:
  void Keep(const std::vector<uint8_t>& kept);

  TrackMemoryOptions options_;
  size_t capacity_;
  DescriptorMatcher matcher_;
  std::vector<LostTrack> tracks_;
  Descriptors descriptors_;  ///< row i of tracks_[i]
  Descriptors kept_descriptors_;
  MatchGuide guide_;
  std::vector<Eigen::Vector2f> keypoint_pixels_;
  std::vector<FeatureMatch> matches_;
  std::vector<uint8_t> kept_;
  std::vector<size_t> order_;
};

}  // namespace regolith
