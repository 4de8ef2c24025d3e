// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/core/span.h"

namespace regolith {

/// A height (m) at x, y (m).
using HeightFunction = std::function<double(double x, double y)>;

/// Height differences (m) over `distance` m, of profiles in all directions at `samples` seeded
/// places of `box`: the same places for every function.
std::vector<double> HeightDifferences(const HeightFunction& height, const Eigen::AlignedBox2d& box,
                                      double distance, int samples);

double RootMeanSquare(const std::vector<double>& values);
double MedianMagnitude(std::vector<double> values);

/// The standard deviation of normal deviates about zero with the same median magnitude; 0 of none.
double RobustSigma(std::vector<double> values);

/// Allan (RMS) deviation ν(L) of the height over `distance` m, from profiles in all directions at
/// `samples` seeded places of `box` (Shepard et al. 2001).
double RmsDeviation(const HeightFunction& height, const Eigen::AlignedBox2d& box, double distance,
                    int samples);

/// Median of |slope| over `distance` m, rad, likewise.
double MedianSlope(const HeightFunction& height, const Eigen::AlignedBox2d& box, double distance,
                   int samples);

/// The Hurst exponent between two distances: d log ν / d log L.
double HurstExponent(const HeightFunction& height, const Eigen::AlignedBox2d& box, double shorter,
                     double longer, int samples);

}  // namespace regolith
