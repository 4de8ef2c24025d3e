// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace regolith {

/// Band-limited noise of one octave: zero mean, twice continuously differentiable, about one cycle
/// in each unit of x and y (Perlin 2002, "Improving noise"; gradients are uniform in a square, so
/// that they need neither a table nor a branch). Depends on its arguments alone.
double GradientNoise(uint32_t seed, double x, double y);

/// Places (x + i · step_x, y + i · step_y), i < count, in units of the lattice.
struct NoiseRow {
  double x = 0.0;
  double y = 0.0;
  double step_x = 0.0;
  double step_y = 0.0;
  int count = 0;
};

/// Adds amplitude · GradientNoise at each place to `out`: the same function, in vector
/// instructions. In single precision the places are exact to 1e-5 of the lattice.
void AddGradientNoise(uint32_t seed, const NoiseRow& row, float amplitude, float* out);
void AddGradientNoise(uint32_t seed, const NoiseRow& row, double amplitude, double* out);

/// The standard deviation of GradientNoise over the plane.
inline constexpr double kGradientNoiseSigma = 0.1761;

}  // namespace regolith
