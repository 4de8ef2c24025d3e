// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/backend/loop_verifier_options.h"
#include "regolith/core/span.h"
#include "regolith/core/thread_pool.h"
#include "regolith/geometry/se3.h"

namespace regolith {

/// Mean heights of the ground around a place, in square cells. Its frame is level (z up) with the
/// origin at the place.
class ReliefImage {
 public:
  /// A cell that has points, at their mean.
  struct Cell {
    float x = 0.0F;         ///< m
    float y = 0.0F;         ///< m
    float z = 0.0F;         ///< m
    float variance = 0.0F;  ///< m², of the heights in it: a rock's flank says little
  };
  /// NaN where nothing was seen.
  struct Height {
    float z = 0.0F;         ///< m
    float variance = 0.0F;  ///< m²
  };

  ReliefImage(Span<const Eigen::Vector3d> points_level, const ReliefMatchOptions& options);

  const std::vector<Cell>& cells() const { return cells_; }
  /// The cell at (x, y).
  Height At(float x, float y) const;
  /// Interpolated between the four cells around; NaN unless all were seen.
  Height Between(float x, float y) const;

 private:
  float inverse_size_;
  int half_;   ///< cells from the middle to the border
  int width_;  ///< cells
  std::vector<Height> heights_;
  std::vector<Cell> cells_;
};

/// Where the search looks: around the guess.
struct ReliefSearch {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m: the query's place in the target's frame
  double radius = 3.0;                               ///< m, in x and y
  double yaw_radius = 0.1;                           ///< rad, about the query's place
};

struct ReliefMatch {
  bool found = false;                                ///< false: nowhere do they share enough cells
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();  ///< m, of the query from the guess
  double yaw = 0.0;                                  ///< rad, likewise
  double height = 0.0;                               ///< m, mean of target minus query there
  double agreement = 0.0;  ///< 2 cov(a, b) / (var(a) + var(b)) of the two reliefs
  double runner_up =
      0.0;        ///< the best agreement elsewhere, looked at as closely as the best can be
  int cells = 0;  ///< in common
};

/// Lays the query over the target at all offsets and yaws of the search and compares the shapes of
/// the ground, less a plane each, since tilts may be off: Lin's concordance (1989), which is 1 for
/// the same shape and about 0 for unrelated ones, on any kind of ground. All offsets are tried, so
/// that a second place that fits as well cannot stay unseen. `query_cells` are in axes of the
/// target's frame as guessed, with the origin at the query's place.
ReliefMatch MatchRelief(Span<const ReliefImage::Cell> query_cells, const ReliefImage& target,
                        const ReliefSearch& search, const LoopVerifierOptions& options,
                        ThreadPool* threads);

/// The agreement at one pose, without the grid's steps: heights between cells are interpolated. -1
/// where fewer than `min_cells` are in common. `T_target_query`: of the query's frame (in which its
/// cells are) in the target's.
double AgreementAt(Span<const ReliefImage::Cell> query_cells, const ReliefImage& target,
                   const SE3& T_target_query, int min_cells);

}  // namespace regolith
