// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/terrain/post_block.h"
#include "regolith/terrain/terrain_options.h"

namespace regolith {

/// Fragments of 1 to 5 cm as bumps of the ground, where posts are dense enough to carry them.
class ClodField {
 public:
  ClodField(const ClodOptions& options, uint64_t seed);

  /// Height (m) of the clods at (x, y) m, of those that posts `spacing` m apart can carry.
  double Height(double x, double y, double spacing) const;

  /// Adds Height of every post of `block` to `heights`.
  void AddTo(const PostBlock& block, double* heights) const;

 private:
  struct Clod {
    Eigen::Vector2d centre;  ///< m
    Eigen::Vector2d along;   ///< over the half axis, 1/m
    Eigen::Vector2d across;
    double height;          ///< m
    Eigen::Vector2d facet;  ///< slope of the plane that cuts its top, of unit height
    double reach;           ///< m
  };
  /// Sizes within a factor of √5 in a turned lattice of cells; a cell holds one clod or none, and
  /// no clod reaches out of its cell.
  struct Class {
    uint64_t seed;
    double low;
    double high;
    double cell;   ///< m
    double share;  ///< of the cells that hold one
    double cosine;
    double sine;
  };
  std::optional<Clod> Draw(const Class& sizes, int64_t column, int64_t row) const;
  static double HeightOf(const Clod& clod, const Eigen::Vector2d& place);

  double exponent_;
  std::vector<Class> classes_;
};

}  // namespace regolith
