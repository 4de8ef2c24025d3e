// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/features/score_map.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// Weighs a network's scores by how much of a corner the image has there: with λ the smaller
/// eigenvalue of the gradients' matrix over 5 × 5 pixels (Shi and Tomasi 1994), in units of the
/// image's variance, by sqrt((λ + 0.003) / 0.0625). The network says what is worth to be found
/// again, but of what it strides over it says the place no better than to its strides; λ moves with
/// the image exactly. Keeps its buffers.
class CornerWeight {
 public:
  /// Pixels along the edge where the gradients are not known: their scores become 0.
  static constexpr int kMargin = 3;

  /// `scores` is as large as the image.
  void Apply(const Image& image, ScoreMap* scores);

 private:
  /// Sums of gradient products over the five columns around each pixel, for one row.
  struct Products {
    std::vector<int32_t> xx, xy, yy;
  };

  void Resize(size_t width);
  void SumColumns(const Image& image, int row, Products* sums);
  void WeighRow(double variance, float* scores) const;

  std::vector<Products> rows_;  ///< the last five
  Products total_;              ///< of them
  std::vector<int32_t> xx_, xy_, yy_;
};

}  // namespace regolith
