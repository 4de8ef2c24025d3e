// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/features/feature_set.h"

namespace regolith {

/// One vector for a whole image, by which places are found again: VLAD (Jegou et al. 2010) over
/// the image's float descriptors, normalised within each cell of the vocabulary (Arandjelovic and
/// Zisserman 2013) so that a pattern that repeats does not drown the rest. What descriptors differ
/// from their centroid is taken across it alone: descriptors and centroids lie on a sphere, inside
/// of which every mean lies, so along the centroid all images differ from it alike (unrelated ones
/// were 0.9 similar).
class GlobalDescriptor {
 public:
  /// `centroids`, dimension x K, are the vocabulary: unit columns.
  explicit GlobalDescriptor(Eigen::MatrixXf centroids);

  /// Of unit length, K x dimension values: for each centroid in turn the normalised sum of what
  /// the descriptors nearest to it differ from it. Zero where there are no descriptors. Throws
  /// CheckError where they are not floats of the vocabulary's dimension.
  Eigen::VectorXf Describe(const Descriptors& descriptors) const;

  /// Of the result of Describe.
  Eigen::Index size() const { return centroids_.size(); }

 private:
  Eigen::MatrixXf centroids_;
};

/// Cosine of two global descriptors: 1 for the same, about 0 for unrelated images.
float Similarity(const Eigen::VectorXf& first, const Eigen::VectorXf& second);

}  // namespace regolith
