// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/features/feature_extractor.h"

namespace regolith {

/// An image cut into cells of about one size: what keypoints are spread over, and what their spread
/// is counted by.
class KeypointGrid {
 public:
  KeypointGrid() = default;
  KeypointGrid(int width, int height, int cell_size);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int cells() const { return columns_ * rows_; }
  /// Pixels outside the image count to the nearest cell.
  int CellOf(const Eigen::Vector2f& pixel) const;

  /// Writes cells and cells_filled.
  void CountFilled(Span<const Eigen::Vector2f> pixels, DetectionStatus* status) const;

 private:
  int columns_ = 1;
  int rows_ = 1;
  float columns_per_pixel_ = 0.0F;
  float rows_per_pixel_ = 0.0F;
};

/// Takes keypoints cell by cell, so that all cells hold about as many. Keeps its buffers.
class EvenSelection {
 public:
  /// The rows of at most `count` of `candidates`, which are given strongest first. Every cell gives
  /// its strongest, then its second, and so on; the `present` keypoints of a cell count as given.
  void Select(const KeypointGrid& grid, Span<const Eigen::Vector2f> present,
              Span<const Eigen::Vector2f> candidates, int count, std::vector<int>* rows);

 private:
  std::vector<int> in_cell_;
  std::vector<int> rounds_;
};

}  // namespace regolith
