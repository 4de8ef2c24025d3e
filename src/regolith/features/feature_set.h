// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace regolith {

enum class DescriptorType {
  kNone,
  kFloat,   ///< unit length; similarity is the inner product
  kBinary,  ///< 256 bits; distance is the number of bits that differ (Hamming)
};

inline constexpr int kBinaryBytes = 32;

/// One descriptor a keypoint, rows one after the other.
struct Descriptors {
  DescriptorType type = DescriptorType::kNone;
  int dimension = 0;          ///< floats a row; 0 for the other types
  std::vector<float> values;  ///< size × dimension, where kFloat
  std::vector<uint8_t> bits;  ///< size × kBinaryBytes, where kBinary

  size_t size() const;
  const float* Row(size_t index) const {
    return values.data() + index * static_cast<size_t>(dimension);
  }
  const uint8_t* Bits(size_t index) const { return bits.data() + index * kBinaryBytes; }
  /// Empty, of the type and width of `other`.
  void ResetLike(const Descriptors& other);
  /// Appends row `index` of `other`, which is of the same type and width.
  void Append(const Descriptors& other, size_t index);
};

/// The keypoints of one image, strongest first.
struct FeatureSet {
  std::vector<Eigen::Vector2f> pixels;  ///< pixel centres lie at integer coordinates
  std::vector<float> scores;            ///< comparable within one extractor only
  /// Pixels of the image a pixel of the pyramid's level that the keypoint was found in; empty where
  /// all were found in the image itself.
  std::vector<float> scales;
  Descriptors descriptors;  ///< none, or one a keypoint

  size_t size() const { return pixels.size(); }
};

}  // namespace regolith
