// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/features/feature_options.h"
#include "regolith/features/feature_set.h"

namespace regolith {

/// Row `first` of one set belongs to row `second` of another.
struct FeatureMatch {
  int first = 0;
  int second = 0;
  float score =
      0.0F;  ///< float descriptors: inner product; binary: 1 − distance / 256; LK: 1 − error / 255
};

/// Where the matches of each row of the first set are looked for.
struct MatchGuide {
  std::vector<Eigen::Vector2f>
      predicted;             ///< pixel in the second image, one a row of the first set
  std::vector<float> radii;  ///< pixels, one a row of the first set
};

/// Nearest neighbours between two sets of descriptors, exact, by one matrix product (Hamming
/// distances for binary ones), with the ratio test and the mutual check. Keeps its buffers.
class DescriptorMatcher {
 public:
  explicit DescriptorMatcher(const DescriptorMatcherOptions& options);

  /// Matches in order of their first row, into `matches`. With a guide only pairs within the radius
  /// count, also as second nearest; `second_pixels` are the pixels of the second set. Ties go to
  /// the lower row.
  void Match(const Descriptors& first, const Descriptors& second,
             std::vector<FeatureMatch>* matches);
  void MatchGuided(const Descriptors& first, const Descriptors& second, const MatchGuide& guide,
                   const std::vector<Eigen::Vector2f>& second_pixels,
                   std::vector<FeatureMatch>* matches);

 private:
  DescriptorMatcherOptions options_;
  std::vector<float> similarities_;
};

}  // namespace regolith
