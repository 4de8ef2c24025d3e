// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/fractal_noise.h"

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/terrain/gradient_noise.h"

namespace regolith {

FractalNoise::FractalNoise(uint64_t seed, double longest, double shortest, double exponent) {
  REGOLITH_CHECK(shortest > 0.0 && longest >= shortest, longest, " m, ", shortest, " m");
  Random random(seed);
  for (double wavelength = longest; wavelength > 0.999 * shortest; wavelength *= 0.5) {
    Octave octave;
    octave.seed = random.Next();
    octave.wavelength = wavelength;
    octave.amplitude = std::pow(wavelength, exponent) / kGradientNoiseSigma;
    const double turn = random.Uniform(0.0, 2.0 * M_PI);
    octave.cosine = std::cos(turn) / wavelength;
    octave.sine = std::sin(turn) / wavelength;
    octave.shift_x = random.Uniform(0.0, 1000.0);
    octave.shift_y = random.Uniform(0.0, 1000.0);
    octaves_.push_back(octave);
  }
}

double FractalNoise::At(double x, double y, double min_wavelength) const {
  double sum = 0.0;
  for (const Octave& octave : octaves_) {
    if (octave.wavelength < min_wavelength) break;
    const double u = octave.cosine * x - octave.sine * y + octave.shift_x;
    const double v = octave.sine * x + octave.cosine * y + octave.shift_y;
    sum += octave.amplitude * GradientNoise(octave.seed, u, v);
  }
  return sum;
}

double FractalNoise::Sigma() const {
  double variance = 0.0;
  for (const Octave& octave : octaves_) {
    variance += std::pow(octave.amplitude * kGradientNoiseSigma, 2);
  }
  return std::sqrt(variance);
}

}  // namespace regolith
