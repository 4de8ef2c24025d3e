// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "regolith/terrain/post_block.h"

namespace regolith {

/// A sum of octaves of GradientNoise, each turned and shifted against the others so that no
/// lattice shows.
class FractalNoise {
 public:
  /// An octave's standard deviation (m) at its wavelength (m).
  using Spectrum = std::function<double(double wavelength)>;

  /// Wavelengths halve from `longest` down to `shortest`, m. An octave's amplitude (its standard
  /// deviation, m) at wavelength λ (m) is λ^exponent.
  FractalNoise(uint64_t seed, double longest, double shortest, double exponent);
  FractalNoise(uint64_t seed, double longest, double shortest, const Spectrum& spectrum);

  /// The value at (x, y) in m, of the octaves no shorter than `min_wavelength` m.
  double At(double x, double y, double min_wavelength) const;

  /// Adds At of every post of `block` to `values`; the same to 1e-6 of the amplitude.
  void AddTo(const PostBlock& block, double min_wavelength, double* values) const;

  /// Multiplies all amplitudes.
  void Scale(double factor);

  /// The square root of the sum of the octaves' variances.
  double Sigma() const;

  /// The octaves' standard deviation at `wavelength` m, interpolated as a power of it.
  double Amplitude(double wavelength) const;

 private:
  struct Octave {
    uint32_t seed;
    double wavelength;
    double amplitude;
    double cosine;  ///< of its turn, divided by the wavelength
    double sine;
    double shift_x;
    double shift_y;
  };
  std::vector<Octave> octaves_;  ///< longest first
};

}  // namespace regolith
