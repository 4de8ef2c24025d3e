// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
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
///
/// Floats are rounded to 2^-14 first (similarities are then right to about 3e-5, a hundredth of
/// what bf16 inference leaves): sums of integers are the same in any order and on any processor,
/// and multiply twice as fast.
class DescriptorMatcher {
 public:
  explicit DescriptorMatcher(const DescriptorMatcherOptions& options);

  /// Matches in order of their first row, into `matches`. With a guide only pairs within the radius
  /// count, also as second nearest; `second_pixels` are the pixels of the second set. Ties go to
  /// the lower row, and count as ambiguous where the ratio is below 1. The mutual check asks the
  /// ratio of both directions. Throws CheckError where the sets are of differing type or width, or
  /// floats are longer than unit length.
  void Match(const Descriptors& first, const Descriptors& second,
             std::vector<FeatureMatch>* matches);
  void MatchGuided(const Descriptors& first, const Descriptors& second, const MatchGuide& guide,
                   const std::vector<Eigen::Vector2f>& second_pixels,
                   std::vector<FeatureMatch>* matches);

  /// The two most similar rows of the other set. Similarities are integers: 2^28 times the inner
  /// product, or minus the Hamming distance.
  struct Nearest {
    int32_t best = INT32_MIN;    ///< INT32_MIN: none
    int32_t second = INT32_MIN;  ///< INT32_MIN: none
    int32_t index = -1;          ///< row of the best
  };

 private:
  /// Turns the nearest of both directions into matches.
  void Select(DescriptorType type, std::vector<FeatureMatch>* matches) const;

  DescriptorMatcherOptions options_;
  std::vector<int16_t> first_fixed_;   ///< rows in fixed point
  std::vector<int16_t> second_fixed_;  ///< rows in fixed point
  std::vector<int16_t> panels_;        ///< the second set, eight rows interleaved
  std::vector<int32_t> lanes_;         ///< nearest of the first rows, by column modulo eight
  std::vector<int32_t> cell_starts_;   ///< of the second pixels' grid
  std::vector<int32_t> cell_rows_;
  std::vector<Nearest> first_nearest_;
  std::vector<Nearest> second_nearest_;
};

}  // namespace regolith
