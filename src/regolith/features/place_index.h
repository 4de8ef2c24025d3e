// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "regolith/features/feature_set.h"
#include "regolith/features/global_descriptor.h"

namespace regolith {

/// Keyframes by what they look like as a whole (GlobalDescriptor). The vocabulary is made of the
/// first keyframes' own descriptors, by spherical k-means, so that any kind of descriptor has one
/// and no file is needed; until then all keyframes are alike.
class PlaceIndex {
 public:
  PlaceIndex();
  ~PlaceIndex();

  /// Ids increase.
  void Add(int64_t keyframe, const Descriptors& descriptors);
  void Remove(int64_t keyframe) { places_.erase(keyframe); }

  /// At most `count` keyframes, the most similar first; of equal ones the newest.
  std::vector<int64_t> MostSimilar(const Descriptors& descriptors, int count) const;

  /// Of a keyframe; empty as long as there is no vocabulary.
  const Eigen::VectorXf& Global(int64_t keyframe) const { return places_.at(keyframe); }
  bool has_vocabulary() const { return describer_ != nullptr; }

 private:
  Eigen::VectorXf Describe(const Descriptors& descriptors) const;
  void TrainVocabulary();

  std::map<int64_t, Eigen::VectorXf> places_;
  std::map<int64_t, Descriptors> first_;  ///< until there is a vocabulary
  std::unique_ptr<GlobalDescriptor> describer_;
};

/// `words` unit centroids (columns) of unit columns, by spherical k-means from columns spread
/// evenly over the set.
Eigen::MatrixXf SphericalCentroids(const Eigen::MatrixXf& columns, int words);

}  // namespace regolith
