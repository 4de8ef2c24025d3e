// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/geometry/se3.h"

namespace regolith {

/// Errors pose by pose or pair by pair.
struct PoseErrors {
  std::vector<double> translation;  ///< m
  std::vector<double> angle;        ///< rad, in [0, π]
};

/// Two poses of one trajectory.
struct SegmentEnds {
  size_t from = 0;
  size_t to = 0;
};

/// Absolute pose error: of P_i⁻¹ Q_i for estimates P and references Q, the distance between the
/// positions and the angle between the attitudes. Throws CheckError unless both are equally long.
PoseErrors AbsolutePoseErrors(Span<const SE3> reference, Span<const SE3> estimate);

/// Relative pose error of each pair (i, j): norm of the translation and angle of
/// (Q_i⁻¹ Q_j)⁻¹ (P_i⁻¹ P_j) (Sturm et al. 2012).
PoseErrors RelativePoseErrors(Span<const SE3> reference, Span<const SE3> estimate,
                              Span<const SegmentEnds> segments);

/// Pairs (i, i + 1).
std::vector<SegmentEnds> ConsecutivePairs(size_t count);

/// Pairs a length apart along the path, as evo_rpe --delta LENGTH --delta_unit m --all_pairs finds
/// them: for each pose the later one whose distance along the path is nearest to `length`, the
/// first of equally near ones, kept where it is off by no more than tolerance · length.
std::vector<SegmentEnds> PairsByPathLength(Span<const SE3> poses, double length, double tolerance);

/// Sum of the distances between consecutive poses, m.
double PathLength(Span<const SE3> poses);

}  // namespace regolith
