// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "regolith/terrain/fractal_noise.h"
#include "regolith/terrain/terrain_options.h"

namespace regolith {

/// Normal albedo of the ground, log-normal about the mean with the same contrast in each octave.
class AlbedoField {
 public:
  AlbedoField(const AlbedoOptions& options, uint64_t seed);

  /// Normal albedo at (x, y) m, of the scales no shorter than `min_wavelength` m.
  double At(double x, double y, double min_wavelength) const;

 private:
  AlbedoOptions options_;
  FractalNoise noise_;
};

}  // namespace regolith
