// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rock_grain.h"

#include <algorithm>
#include <cmath>

#include "regolith/terrain/gradient_noise.h"

namespace regolith {
namespace {

struct Octave {
  float wavelength;  // m
  float contrast;    // standard deviation of the logarithm of the albedo
  float slope;       // RMS, along one axis
};
constexpr Octave kOctaves[] = {
    {0.3F, 0.10F, 0.10F}, {0.1F, 0.10F, 0.14F}, {0.035F, 0.09F, 0.16F}, {0.012F, 0.08F, 0.16F}};
// Noise of a plane on which the rock's space is projected aslant. Along the third axis it is drawn
// out, as beds are; each octave takes another axis for that, so that no rock is all drapery.
constexpr float kSlantX = 0.55F;
constexpr float kSlantY = -0.35F;
constexpr double kStep = 0.05;  // of a wavelength, for differences
// RMS slope of noise of unit standard deviation and wavelength, along one axis.
constexpr float kSlopeOfNoise = 5.0F;

}  // namespace

RockGrain GrainOfRock(uint32_t seed, const Eigen::Vector3f& place, float width) {
  RockGrain grain;
  float logarithm = 0.0F;
  int first = 0;
  for (const Octave& octave : kOctaves) {
    const float kept = std::clamp(octave.wavelength / width - 1.0F, 0.0F, 1.0F);
    if (kept == 0.0F) break;
    const int second = (first + 1) % 3;
    const int third = (first + 2) % 3;
    const auto x = static_cast<double>((place[first] + kSlantX * place[third]) / octave.wavelength);
    const auto y =
        static_cast<double>((place[second] + kSlantY * place[third]) / octave.wavelength);
    ++seed;
    const double here = GradientNoise(seed, x, y);
    const double scale = 1.0 / (kGradientNoiseSigma * kStep);
    const auto along_x = static_cast<float>(scale * (GradientNoise(seed, x + kStep, y) - here));
    const auto along_y = static_cast<float>(scale * (GradientNoise(seed, x, y + kStep) - here));
    logarithm += kept * octave.contrast * static_cast<float>(here / kGradientNoiseSigma);
    const float slope = kept * octave.slope / kSlopeOfNoise;
    grain.slope[first] += slope * along_x;
    grain.slope[second] += slope * along_y;
    grain.slope[third] += slope * (kSlantX * along_x + kSlantY * along_y);
    first = second;
  }
  grain.brightness = std::exp(logarithm);
  return grain;
}

}  // namespace regolith
