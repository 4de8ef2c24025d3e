// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/albedo.h"

#include <cmath>

namespace regolith {

AlbedoField::AlbedoField(const AlbedoOptions& options, uint64_t seed)
    : options_(options),
      noise_(seed, options.longest_wavelength, options.shortest_wavelength, 0.0) {}

double AlbedoField::At(double x, double y, double min_wavelength) const {
  const double contrast = options_.contrast / noise_.Sigma();
  return options_.mean * std::exp(contrast * noise_.At(x, y, min_wavelength));
}

}  // namespace regolith
