// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "regolith/features/feature_set.h"
#include "regolith/sensor/image.h"
#include "regolith/sensor/rectified_camera.h"
#include "regolith/stereo/stereo_features.h"
#include "regolith/stereo/stereo_options.h"

namespace regolith {

/// Finds the keypoints of the left image of a rectified pair in the right one (Mur-Artal & Tardós
/// 2017, section III-A): by descriptors along the row, then to a fraction of a pixel by the
/// correlation of the patches around, with a parabola through its maximum.
class EpipolarMatcher {
 public:
  EpipolarMatcher(const EpipolarMatcherOptions& options, const RectifiedCamera& camera);
  ~EpipolarMatcher();

  /// Both images are rectified, the keypoints are theirs.
  StereoFeatures Match(const Image& left_image, const Image& right_image, const FeatureSet& left,
                       const FeatureSet& right);

  /// How many keypoints of the last Match would have a partner if the two images were exchanged.
  int CountReversed(const FeatureSet& left, const FeatureSet& right);

 private:
  struct Pyramids;
  /// The right keypoint most like a left one, at disparities from `least` to `most` pixels; -1:
  /// none.
  int FindPartner(const FeatureSet& left, size_t index, const FeatureSet& right, float least,
                  float most) const;
  /// Nothing (kNotSeen) where the patches do not correlate.
  float Refine(const Eigen::Vector2f& left, float right_column, float scale) const;
  void SortByRow(const FeatureSet& right);

  EpipolarMatcherOptions options_;
  RectifiedCamera camera_;
  std::unique_ptr<Pyramids> pyramids_;
  std::vector<std::vector<int>> rows_;  ///< right keypoints of each row
};

}  // namespace regolith
