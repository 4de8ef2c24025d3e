// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/fractal_noise.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/terrain/gradient_noise.h"

namespace regolith {
namespace {

// Longer waves are metres high, where single precision would leave a roughness of micrometres.
constexpr double kSinglePrecisionWavelength = 8.0;  // m

}  // namespace

FractalNoise::FractalNoise(uint64_t seed, double longest, double shortest, double exponent)
    : FractalNoise(seed, longest, shortest,
                   [exponent](double wavelength) { return std::pow(wavelength, exponent); }) {}

FractalNoise::FractalNoise(uint64_t seed, double longest, double shortest,
                           const Spectrum& spectrum) {
  REGOLITH_CHECK(shortest > 0.0 && longest >= shortest, longest, " m, ", shortest, " m");
  Random random(seed);
  for (double wavelength = longest; wavelength > 0.999 * shortest; wavelength *= 0.5) {
    Octave octave;
    octave.seed = static_cast<uint32_t>(random.Next() >> 32);
    octave.wavelength = wavelength;
    octave.amplitude = spectrum(wavelength) / kGradientNoiseSigma;
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

void FractalNoise::AddTo(const PostBlock& block, double min_wavelength, double* values) const {
  std::vector<float> fine(static_cast<size_t>(block.columns));
  for (int j = 0; j < block.rows; ++j, values += block.columns) {
    const double y = block.y + j * block.spacing;
    std::fill(fine.begin(), fine.end(), 0.0F);
    for (const Octave& octave : octaves_) {
      if (octave.wavelength < min_wavelength) break;
      const NoiseRow row{octave.cosine * block.x - octave.sine * y + octave.shift_x,
                         octave.sine * block.x + octave.cosine * y + octave.shift_y,
                         octave.cosine * block.spacing, octave.sine * block.spacing, block.columns};
      if (octave.wavelength > kSinglePrecisionWavelength) {
        AddGradientNoise(octave.seed, row, octave.amplitude, values);
      } else {
        AddGradientNoise(octave.seed, row, static_cast<float>(octave.amplitude), fine.data());
      }
    }
    for (size_t i = 0; i < fine.size(); ++i) values[i] += static_cast<double>(fine[i]);
  }
}

void FractalNoise::Scale(double factor) {
  for (Octave& octave : octaves_) octave.amplitude *= factor;
}

double FractalNoise::Sigma() const {
  double variance = 0.0;
  for (const Octave& octave : octaves_) {
    variance += std::pow(octave.amplitude * kGradientNoiseSigma, 2);
  }
  return std::sqrt(variance);
}

double FractalNoise::Amplitude(double wavelength) const {
  size_t i = 0;
  while (i + 2 < octaves_.size() && octaves_[i + 1].wavelength > wavelength) ++i;
  const Octave& longer = octaves_[i];
  if (octaves_.size() < 2) return longer.amplitude * kGradientNoiseSigma;
  const double share = std::log2(longer.wavelength / wavelength);
  return kGradientNoiseSigma * longer.amplitude *
         std::pow(octaves_[i + 1].amplitude / longer.amplitude, share);
}

}  // namespace regolith
