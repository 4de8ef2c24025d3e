// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

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
};

struct VisualPlacesOptions {
  double min_similarity = 0.2;  ///< of the global descriptors
  int max_places = 3;           ///< the most similar, whose features are matched
  int min_inliers = 15;         ///< features that agree on one pose
  double angle_error = 0.006;   ///< rad, of an inlier
  int iterations = 300;         ///< of RANSAC
  DescriptorMatcherOptions matcher;
  double position_doubt = 1.0;  ///< m that a pose found may be off by …
  double yaw_doubt = 0.08;      ///< … and rad

  void Check() const;
};

/// Proposes loops by what the camera saw: the most similar images by their global descriptor, their
/// features matched, and the pose from which the old one's points are seen so (EPnP in RANSAC;
/// Lepetit et al. 2009). For Backend::TryLoop.
class VisualPlaces {
 public:
  VisualPlaces(const VisualPlacesOptions& options, const SE3& T_body_camera);

  /// Keyframes in increasing order.
  void Add(size_t keyframe, PlaceView view);
  /// Candidates for the newest view among the keyframes before `end`.
  std::vector<LoopCandidate> Propose(size_t end);

 private:
  struct Place {
    size_t keyframe = 0;
    PlaceView view;
  };
  /// T_old_new of the cameras; nothing where too few features agree.
  std::optional<SE3> RelativePose(const PlaceView& old_view, const PlaceView& new_view);

  VisualPlacesOptions options_;
  SE3 T_body_camera_;
  DescriptorMatcher matcher_;
  std::vector<Place> places_;
};

}  // namespace regolith
