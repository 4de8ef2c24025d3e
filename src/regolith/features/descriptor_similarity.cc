// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/descriptor_similarity.h"

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/features/hamming.h"

namespace regolith {
namespace {

constexpr int kBits = 8 * kBinaryBytes;

}  // namespace

float DescriptorSimilarity(const Descriptors& first, size_t first_row, const Descriptors& second,
                           size_t second_row) {
  if (first.type == DescriptorType::kBinary) {
    return SimilarityOfHamming(HammingDistance(first.Bits(first_row), second.Bits(second_row)));
  }
  const float* a = first.Row(first_row);
  const float* b = second.Row(second_row);
  float sum = 0.0F;
  for (int i = 0; i < first.dimension; ++i) sum += a[i] * b[i];
  return sum;
}

float SimilarityOfHamming(int bits) {
  return 1.0F - 2.0F * static_cast<float>(bits) / static_cast<float>(kBits);
}

Eigen::MatrixXf UnitDescriptors(const Descriptors& descriptors) {
  const auto count = static_cast<Eigen::Index>(descriptors.size());
  if (descriptors.type == DescriptorType::kFloat) {
    return Eigen::Map<const Eigen::MatrixXf>(descriptors.values.data(), descriptors.dimension,
                                             count);
  }
  REGOLITH_CHECK(descriptors.type == DescriptorType::kBinary, "no descriptors");
  const float value = 1.0F / std::sqrt(static_cast<float>(kBits));
  Eigen::MatrixXf columns(kBits, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const uint8_t* bits = descriptors.Bits(static_cast<size_t>(i));
    for (int bit = 0; bit < kBits; ++bit) {
      columns(bit, i) = ((bits[bit / 8] >> (bit % 8)) & 1) != 0 ? value : -value;
    }
  }
  return columns;
}

}  // namespace regolith
