// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace regolith {

/// Square distance (pixels) of a point from the epipolar line of the other, from the mean of both
/// images: like Sampson's distance it is right where one image is nearer than the other.
double SquareLineDistance(const Eigen::Matrix3d& F_second_first, const Eigen::Vector2d& first,
                          const Eigen::Vector2d& second);

/// Least squares of the distances from epipolar lines (of about `threshold` pixels) over all
/// points, with weights that leave out what is far off. Points that many matrices fit, as those of
/// a plane, are fitted by one of them. Never worse than `initial`.
Eigen::Matrix3d RefineFundamental(const std::vector<Eigen::Vector2d>& first,
                                  const std::vector<Eigen::Vector2d>& second,
                                  const Eigen::Matrix3d& initial, double threshold);

}  // namespace regolith
