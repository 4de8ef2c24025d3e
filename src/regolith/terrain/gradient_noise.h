// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace regolith {

/// Band-limited noise of one octave: zero mean, twice continuously differentiable, about one cycle
/// in each unit of x and y (Perlin 2002, "Improving noise"). Depends on its arguments alone.
double GradientNoise(uint64_t seed, double x, double y);

/// The standard deviation of GradientNoise over the plane.
inline constexpr double kGradientNoiseSigma = 0.2157;

}  // namespace regolith
