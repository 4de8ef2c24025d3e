// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/geometry/se3.h"

namespace regolith {

/// Residuals beyond this many standard deviations lose their weight (Geman–McClure).
inline constexpr double kKernelSigmas = 3.0;

/// The standard deviation of residuals by the median of their magnitudes (1.4826 · median, which
/// outliers do not reach), at least `floor`; the floor where there are none.
double RobustScale(std::vector<double> magnitudes, double floor);

/// Whether a search moved the pose by less than both tolerances (rad, m), so that another would
/// bring nothing.
bool HasConverged(const SE3& before, const SE3& after, double rotation_tolerance,
                  double position_tolerance);

}  // namespace regolith
