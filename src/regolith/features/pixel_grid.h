// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace regolith {

/// Finds the pixels within a radius: they are sorted into square cells. Pixels that are not finite
/// are never found. The pixels and both buffers belong to the caller and must outlive it.
class PixelGrid {
 public:
  PixelGrid(const std::vector<Eigen::Vector2f>& pixels, std::vector<int32_t>* cell_starts,
            std::vector<int32_t>* cell_rows);

  /// Calls visit(index) for each pixel with |pixel - centre| <= radius, in no order to rely on.
  template <typename Visit>
  void ForEachWithin(const Eigen::Vector2f& centre, float radius, const Visit& visit) const {
    if (!centre.allFinite() || !(radius >= 0.0F) || columns_ == 0) return;
    // Rounding in the test below may let in pixels just outside: their cells are looked at too.
    const float reach = radius * 1.001F + 0.01F;
    const size_t left = Cell(centre.x() - reach - origin_.x(), columns_);
    const size_t right = Cell(centre.x() + reach - origin_.x(), columns_);
    const size_t top = Cell(centre.y() - reach - origin_.y(), rows_);
    const size_t bottom = Cell(centre.y() + reach - origin_.y(), rows_);
    for (size_t row = top; row <= bottom; ++row) {
      const auto begin = static_cast<size_t>(cell_starts_[row * columns_ + left]);
      const auto end = static_cast<size_t>(cell_starts_[row * columns_ + right + 1]);
      for (size_t i = begin; i < end; ++i) {
        const auto index = static_cast<size_t>(cell_rows_[i]);
        if ((pixels_[index] - centre).squaredNorm() <= radius * radius) visit(index);
      }
    }
  }

 private:
  /// Of a place so far from the origin, clamped to the grid.
  size_t Cell(float offset, size_t count) const;

  const Eigen::Vector2f* pixels_;
  const int32_t* cell_starts_ = nullptr;  ///< one a cell, row by row, and the end
  const int32_t* cell_rows_ = nullptr;    ///< indices of pixels, cell by cell
  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();
  float cell_size_ = 1.0F;
  size_t columns_ = 0;
  size_t rows_ = 0;
};

}  // namespace regolith
