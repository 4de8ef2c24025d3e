// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "regolith/backend/loop_consistency.h"
#include "regolith/backend/loop_detector.h"
#include "regolith/features/descriptor_matcher.h"
#include "regolith/features/feature_set.h"

namespace regolith {

/// What a camera saw at a keyframe.
struct PlaceView {
  Eigen::VectorXf global;                 ///< GlobalDescriptor::Describe
  Descriptors descriptors;                ///< of the image's features
  std::vector<Eigen::Vector3d> bearings;  ///< unit, camera frame, one a feature
  std::vector<double> ranges;             ///< m along the bearing, from lidar or window; 0: unknown
  SE3 T_body_camera;                      ///< of the keyframe's body, when the image was taken
};

struct VisualPlacesOptions {
  int matched_places = 16;     ///< the most similar, whose features are matched for a proposal
  int max_places = 3;          ///< that a pose is sought of: those with the most matches
  int min_inliers = 12;        ///< features that agree on the pose of a proposal
  double angle_error = 0.006;  ///< rad, of an inlier
  int iterations = 300;        ///< of RANSAC
  DescriptorMatcherOptions matcher;
  /// m that a pose proposed is taken to be off by: far more than it is, so that the lidar sees
  /// whether the ground fits elsewhere too (LoopVerifierOptions::separation) …
  double position_doubt = 3.0;
  double yaw_doubt = 0.08;  ///< … and rad
  /// Of a loop that images alone confirm, among the `max_places` most similar: the least similarity
  /// of the global descriptors …
  double min_similarity = 0.2;
  int confirmed_inliers = 30;        ///< … features that agree, of either view in the other …
  double confirmed_position = 0.15;  ///< m that the poses of the two directions may differ by …
  double confirmed_rotation = 0.02;  ///< … and rad
  double position_sigma = 0.05;      ///< m, 1 σ of such a loop …
  double rotation_sigma = 0.006;     ///< … and rad

  void Check() const;
};

/// Proposes loops by what the camera saw: of the most similar images by their global descriptor
/// those with the most matched features, and the pose from which the old one's points are seen so
/// (EPnP in RANSAC; Lepetit et al. 2009). For Backend::TryLoop.
class VisualPlaces {
 public:
  explicit VisualPlaces(const VisualPlacesOptions& options);

  /// Keyframes in increasing order.
  void Add(size_t keyframe, PlaceView view);
  /// Candidates for the newest view among the keyframes before `end`.
  std::vector<LoopCandidate> Propose(size_t end);

  /// Loops of the newest view with keyframes before `end` that need nothing else to confirm them
  /// (Backend::AddLoop): the old points are seen by the new view, the new ones by the old, each by
  /// enough features, and both say the same pose.
  std::vector<LoopMeasurement> Confirmed(size_t end);

 private:
  struct Place {
    size_t keyframe = 0;
    PlaceView view;
  };
  /// Features that an old view and a new one share.
  struct Correspondences {
    std::vector<Eigen::Vector3d> points;    ///< m, old camera
    std::vector<Eigen::Vector3d> bearings;  ///< new camera
  };

  /// Indices of the most similar places before `end`, at most `count`, with the similarity.
  std::vector<std::pair<float, size_t>> MostSimilar(size_t end, double min_similarity,
                                                    int count) const;
  /// Of features whose range is known in the old view.
  Correspondences Match(const PlaceView& old_view, const PlaceView& new_view);
  /// T_old_new of the cameras; nothing where too few features agree.
  std::optional<SE3> RelativeCameraPose(const Correspondences& correspondences,
                                        int min_inliers) const;

  VisualPlacesOptions options_;
  DescriptorMatcher matcher_;
  std::vector<Place> places_;
};

}  // namespace regolith
