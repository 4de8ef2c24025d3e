// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/place_index.h"

#include <algorithm>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/features/descriptor_similarity.h"

namespace regolith {
namespace {

constexpr size_t kTrainingKeyframes = 8;
constexpr Eigen::Index kTrainingColumns = 3000;
constexpr int kWords = 16;
constexpr int kRounds = 10;

Descriptors FloatDescriptors(const Descriptors& descriptors) {
  const Eigen::MatrixXf columns = UnitDescriptors(descriptors);
  Descriptors floats;
  floats.type = DescriptorType::kFloat;
  floats.dimension = static_cast<int>(columns.rows());
  floats.values.assign(columns.data(), columns.data() + columns.size());
  return floats;
}

}  // namespace

PlaceIndex::PlaceIndex() = default;
PlaceIndex::~PlaceIndex() = default;

Eigen::MatrixXf SphericalCentroids(const Eigen::MatrixXf& columns, int words) {
  REGOLITH_CHECK(words >= 1 && columns.cols() >= words, columns.cols(), " columns for ", words);
  Eigen::MatrixXf centroids(columns.rows(), words);
  for (int i = 0; i < words; ++i) centroids.col(i) = columns.col(i * columns.cols() / words);
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXf similarities = centroids.transpose() * columns;
    Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(columns.rows(), words);
    for (Eigen::Index i = 0; i < columns.cols(); ++i) {
      Eigen::Index nearest = 0;
      similarities.col(i).maxCoeff(&nearest);
      sums.col(nearest) += columns.col(i);
    }
    for (int i = 0; i < words; ++i) {
      const float length = sums.col(i).norm();
      // One that lost all its columns stays where it was.
      if (length > 1e-6F) centroids.col(i) = sums.col(i) / length;
    }
  }
  return centroids;
}

void PlaceIndex::Add(int64_t keyframe, const Descriptors& descriptors) {
  places_[keyframe] = Describe(descriptors);
  if (describer_) return;
  first_[keyframe] = descriptors;
  if (first_.size() >= kTrainingKeyframes) TrainVocabulary();
}

void PlaceIndex::TrainVocabulary() {
  Eigen::Index count = 0;
  for (const auto& [keyframe, descriptors] : first_) {
    count += static_cast<Eigen::Index>(descriptors.size());
  }
  if (count < kWords) return;
  const Eigen::Index step = std::max<Eigen::Index>(1, count / kTrainingColumns);
  Eigen::MatrixXf columns;
  Eigen::Index place = 0;
  Eigen::Index kept = 0;
  for (const auto& [keyframe, descriptors] : first_) {
    const Eigen::MatrixXf all = UnitDescriptors(descriptors);
    if (columns.size() == 0) columns.resize(all.rows(), (count + step - 1) / step);
    for (Eigen::Index i = 0; i < all.cols(); ++i, ++place) {
      if (place % step == 0) columns.col(kept++) = all.col(i);
    }
  }
  describer_ = std::make_unique<GlobalDescriptor>(SphericalCentroids(columns, kWords));
  for (const auto& [keyframe, descriptors] : std::exchange(first_, {})) {
    if (places_.count(keyframe) > 0) places_[keyframe] = Describe(descriptors);
  }
}

Eigen::VectorXf PlaceIndex::Describe(const Descriptors& descriptors) const {
  if (!describer_ || descriptors.size() == 0) return {};
  return descriptors.type == DescriptorType::kFloat
             ? describer_->Describe(descriptors)
             : describer_->Describe(FloatDescriptors(descriptors));
}

std::vector<int64_t> PlaceIndex::MostSimilar(const Descriptors& descriptors, int count) const {
  const Eigen::VectorXf global = Describe(descriptors);
  std::vector<std::pair<float, int64_t>> similar;
  for (const auto& [keyframe, place] : places_) {
    const bool is_known = global.size() > 0 && place.size() > 0;
    similar.emplace_back(is_known ? Similarity(place, global) : 0.0F, keyframe);
  }
  std::sort(similar.begin(), similar.end(), [](const auto& a, const auto& b) { return a > b; });
  std::vector<int64_t> keyframes;
  for (size_t i = 0; i < std::min(similar.size(), static_cast<size_t>(count)); ++i) {
    keyframes.push_back(similar[i].second);
  }
  return keyframes;
}

}  // namespace regolith
