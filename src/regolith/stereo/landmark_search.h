// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/features/descriptor_matcher.h"
#include "regolith/stereo/stereo_map.h"
#include "regolith/stereo/stereo_options.h"

namespace regolith {

/// A point that is looked for in an image.
struct SearchPoint {
  Eigen::Vector3d predicted = Eigen::Vector3d::Zero();  ///< pixels, RectifiedCamera::Project
  float radius = 0.0F;                                  ///< pixels
  float scale = 0.0F;                                   ///< expected; 0: unknown
  const Descriptors* descriptors = nullptr;             ///< its own is one of these
  size_t row = 0;
};

/// Feature `row` as a point that is looked for elsewhere, `radius` pixels at scale 1 around its
/// predicted place. The features outlive it.
SearchPoint FeatureAsPoint(const StereoFeatures& features, size_t row,
                           const Eigen::Vector3d& predicted, double radius);

/// Finds known points among the features of an image by their descriptors. Keeps its buffers.
class LandmarkSearch {
 public:
  LandmarkSearch(const LandmarkSearchOptions& options, const RectifiedCamera& camera);

  /// What is near its predicted place: the nearest descriptor, mutually. `exclusive`: that also has
  /// to be nearer than the second by the ratio of images.
  std::vector<FeatureMatch> ByPlace(const std::vector<SearchPoint>& points,
                                    const StereoFeatures& features, bool exclusive);
  /// The same wherever it is in the image.
  std::vector<FeatureMatch> Anywhere(const Descriptors& points, const Descriptors& features);

  /// Where a landmark would be seen from a pose, and how large; nothing where it would not: outside
  /// the image, behind the camera, or from another side than ever before.
  std::optional<SearchPoint> Predict(const StereoMap& map, const StereoLandmark& landmark,
                                     const SE3& T_world_camera, double radius) const;

 private:
  LandmarkSearchOptions options_;
  RectifiedCamera camera_;
  DescriptorMatcher exclusive_;
  DescriptorMatcher nearest_;
  DescriptorMatcher anywhere_;
  Descriptors queries_;
  MatchGuide guide_;
};

}  // namespace regolith
