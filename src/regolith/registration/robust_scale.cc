// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/robust_scale.h"

#include <utility>

#include "regolith/core/median.h"

#include <algorithm>

namespace regolith {
namespace {

// Makes the median of |r| a standard deviation for Gaussian r.
constexpr double kMedianToSigma = 1.4826;

}  // namespace

double RobustScale(std::vector<double> magnitudes, double floor) {
  if (magnitudes.empty()) return floor;
  return std::max(floor, kMedianToSigma * Median(std::move(magnitudes)));
}

bool HasConverged(const SE3& before, const SE3& after, double rotation_tolerance,
                  double position_tolerance) {
  const Vector6d change = Minus(after, before);
  return change.head<3>().norm() < rotation_tolerance &&
         change.tail<3>().norm() < position_tolerance;
}

}  // namespace regolith
