// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace regolith {

/// A sum of octaves of GradientNoise with amplitudes wavelength^exponent, each turned and shifted
/// against the others so that no lattice shows.
class FractalNoise {
 public:
  /// Wavelengths halve from `longest` down to `shortest`, m. An octave's amplitude (its standard
  /// deviation, m) at wavelength λ (m) is λ^exponent.
  FractalNoise(uint64_t seed, double longest, double shortest, double exponent);

  /// The value at (x, y) in m, of the octaves no shorter than `min_wavelength` m.
  double At(double x, double y, double min_wavelength) const;

  /// The square root of the sum of the octaves' variances.
  double Sigma() const;

 private:
  struct Octave {
    uint64_t seed;
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
