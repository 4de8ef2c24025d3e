// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/terrain/height_grid.h"
#include "regolith/terrain/post_block.h"

namespace regolith {

/// An elevation model between its posts: bicubic (Catmull–Rom), once continuously differentiable.
/// Beyond its border it repeats the border's heights; holes far from the path take their nearest
/// neighbours' heights.
class Dem {
 public:
  /// Throws InputError where the grid has no data at all or is smaller than 4 × 4.
  explicit Dem(const HeightGrid& grid);

  /// Height (m) at x, y (m, frame `map` with the origin in the grid's centre).
  double Height(double x, double y) const;

  /// Adds Height of every post of `block` to `heights`.
  void AddTo(const PostBlock& block, double* heights) const;

  /// Whether every post within `margin` m of (x, y) is data of the model itself.
  bool HasData(double x, double y, double margin) const;

  /// Half of its width and height, m: it covers [-h, h].
  Eigen::Vector2d half_size() const;
  double spacing() const { return grid_.spacing; }

 private:
  Eigen::Vector2d ToPost(double x, double y) const;
  double Clamped(int column, int row) const;

  HeightGrid grid_;           ///< holes filled, heights relative to the mean
  std::vector<char> filled_;  ///< 1 where the model had no data
};

}  // namespace regolith
