// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/descriptor_matcher.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"
#include "regolith/features/hamming.h"
#include "regolith/features/nearest_sweep.h"
#include "regolith/features/pixel_grid.h"

namespace regolith {
namespace {

using Nearest = DescriptorMatcher::Nearest;

constexpr float kFixedOne = 16384.0F;  // 2^14
constexpr double kSimilarityUnit = 1.0 / (1 << 28);

/// Rows in fixed point, each padded with zeros to `stride`, followed by zero rows up to `rows`.
void ToFixedPoint(const Descriptors& descriptors, size_t stride, size_t rows,
                  std::vector<int16_t>* fixed) {
  fixed->assign(rows * stride, 0);
  const auto dimension = static_cast<size_t>(descriptors.dimension);
  for (size_t row = 0; row < descriptors.size(); ++row) {
    const float* values = descriptors.Row(row);
    int16_t* out = fixed->data() + row * stride;
    const double length =
        std::sqrt(Eigen::Map<const Eigen::VectorXf>(values, descriptors.dimension).squaredNorm());
    // Up to this length no value leaves 16 bits and no sum of products 32.
    REGOLITH_CHECK(length <= 1.4, "descriptor ", row, " is of length ", length,
                   ", not of unit length");
    for (size_t i = 0; i < dimension; ++i) {
      const float value = values[i] * kFixedOne;
      out[i] = static_cast<int16_t>(value + std::copysign(0.5F, value));
    }
  }
}

int32_t Dot(const int16_t* first, const int16_t* second, size_t stride) {
  int32_t sum = 0;
  for (size_t i = 0; i < stride; ++i) sum += first[i] * second[i];
  return sum;
}

int32_t HammingSimilarity(const uint8_t* first, const uint8_t* second) {
  return -HammingDistance(first, second);
}

void Consider(int32_t similarity, int32_t index, Nearest* nearest) {
  if (similarity > nearest->best || (similarity == nearest->best && index < nearest->index)) {
    nearest->second = nearest->best;
    nearest->best = similarity;
    nearest->index = index;
  } else {
    nearest->second = std::max(nearest->second, similarity);
  }
}

/// Considers the pair (row, column) for both.
template <typename Similarity>
void ConsiderPair(const Similarity& similarity, size_t row, size_t column,
                  std::vector<Nearest>* rows, std::vector<Nearest>* columns) {
  const int32_t value = similarity(row, column);
  Consider(value, static_cast<int32_t>(column), &(*rows)[row]);
  Consider(value, static_cast<int32_t>(row), &(*columns)[column]);
}

bool SameKind(const Descriptors& first, const Descriptors& second) {
  return first.type == second.type && first.dimension == second.dimension;
}

double Distance(DescriptorType type, int32_t similarity) {
  if (type == DescriptorType::kBinary) return -similarity;
  return std::sqrt(std::max(0.0, 2.0 - 2.0 * similarity * kSimilarityUnit));
}

bool IsUnambiguous(DescriptorType type, const Nearest& nearest, double ratio) {
  if (nearest.second == INT32_MIN || ratio >= 1.0) return true;
  if (nearest.best == nearest.second) return false;  // also where both distances are 0
  return Distance(type, nearest.best) <= ratio * Distance(type, nearest.second);
}

}  // namespace

DescriptorMatcher::DescriptorMatcher(const DescriptorMatcherOptions& options) : options_(options) {
  options_.Check();
}

void DescriptorMatcher::Match(const Descriptors& first, const Descriptors& second,
                              std::vector<FeatureMatch>* matches) {
  matches->clear();
  if (first.size() == 0 || second.size() == 0) return;
  REGOLITH_CHECK(SameKind(first, second), "dimension=", first.dimension, " and ", second.dimension);
  first_nearest_.assign(first.size(), {});
  second_nearest_.assign(second.size(), {});
  if (first.type == DescriptorType::kFloat) {
    const size_t stride = FixedStride(first.dimension);
    ToFixedPoint(first, stride, PaddedRows(first.size()), &first_fixed_);
    ToFixedPoint(second, stride, PaddedColumns(second.size()), &second_fixed_);
    InterleavePanels(second_fixed_, stride, &panels_);
    SweepNearest(first_fixed_, panels_, stride, &lanes_, &first_nearest_, &second_nearest_);
  } else {
    const auto similarity = [&](size_t row, size_t column) {
      return HammingSimilarity(first.Bits(row), second.Bits(column));
    };
    for (size_t row = 0; row < first.size(); ++row) {
      for (size_t column = 0; column < second.size(); ++column) {
        ConsiderPair(similarity, row, column, &first_nearest_, &second_nearest_);
      }
    }
  }
  Select(first.type, matches);
}

void DescriptorMatcher::MatchGuided(const Descriptors& first, const Descriptors& second,
                                    const MatchGuide& guide,
                                    const std::vector<Eigen::Vector2f>& second_pixels,
                                    std::vector<FeatureMatch>* matches) {
  matches->clear();
  REGOLITH_CHECK(guide.predicted.size() == first.size() && guide.radii.size() == first.size(),
                 guide.predicted.size(), " and ", guide.radii.size(), " for ", first.size());
  REGOLITH_CHECK(second_pixels.size() == second.size(), second_pixels.size(), " for ",
                 second.size());
  if (first.size() == 0 || second.size() == 0) return;
  REGOLITH_CHECK(SameKind(first, second), "dimension=", first.dimension, " and ", second.dimension);
  first_nearest_.assign(first.size(), {});
  second_nearest_.assign(second.size(), {});
  const PixelGrid grid(second_pixels, &cell_starts_, &cell_rows_);
  const auto sweep = [&](const auto& similarity) {
    for (size_t row = 0; row < first.size(); ++row) {
      grid.ForEachWithin(guide.predicted[row], guide.radii[row], [&](size_t column) {
        ConsiderPair(similarity, row, column, &first_nearest_, &second_nearest_);
      });
    }
  };
  if (first.type == DescriptorType::kFloat) {
    const size_t stride = FixedStride(first.dimension);
    ToFixedPoint(first, stride, first.size(), &first_fixed_);
    ToFixedPoint(second, stride, second.size(), &second_fixed_);
    sweep([&](size_t row, size_t column) {
      return Dot(first_fixed_.data() + row * stride, second_fixed_.data() + column * stride,
                 stride);
    });
  } else {
    sweep([&](size_t row, size_t column) {
      return HammingSimilarity(first.Bits(row), second.Bits(column));
    });
  }
  Select(first.type, matches);
}

void DescriptorMatcher::Select(DescriptorType type, std::vector<FeatureMatch>* matches) const {
  const bool binary = type == DescriptorType::kBinary;
  for (size_t row = 0; row < first_nearest_.size(); ++row) {
    const Nearest& nearest = first_nearest_[row];
    if (nearest.index < 0) continue;
    const double similarity = nearest.best * kSimilarityUnit;
    if (binary ? -nearest.best > options_.max_hamming : similarity < options_.min_similarity) {
      continue;
    }
    if (!IsUnambiguous(type, nearest, options_.ratio)) continue;
    if (options_.mutual) {
      const Nearest& back = second_nearest_[static_cast<size_t>(nearest.index)];
      if (back.index != static_cast<int32_t>(row)) continue;
      if (!IsUnambiguous(type, back, options_.ratio)) continue;
    }
    const double score = binary ? 1.0 + nearest.best / 256.0 : similarity;
    matches->push_back({static_cast<int>(row), nearest.index, static_cast<float>(score)});
  }
}

}  // namespace regolith
