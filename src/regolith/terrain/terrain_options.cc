// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/terrain_options.h"

#include <string>

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

void CheckRange(const std::string& key, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InputError(key, Concatenate(value, " is out of bounds; expected ", low, " to ", high));
}

}  // namespace

void ReliefOptions::Check() const {
  CheckRange("terrain.relief.hurst", hurst, 0.3, 1.0);
  CheckRange("terrain.relief.slope_deg", slope_deg, 0.0, 20.0);
  CheckRange("terrain.relief.shortest_wavelength", shortest_wavelength, 0.005, 1.0);
  CheckRange("terrain.relief.longest_wavelength", longest_wavelength, 2.0, 10000.0);
}

void CraterOptions::Check() const {
  CheckRange("terrain.craters.density", density, 0.0, 1.0);
  CheckRange("terrain.craters.min_diameter", min_diameter, 0.05, 100.0);
  CheckRange("terrain.craters.max_diameter", max_diameter, min_diameter, 1000.0);
  CheckRange("terrain.craters.equilibrium_diameter", equilibrium_diameter, min_diameter, 1000.0);
  CheckRange("terrain.craters.fresh_depth", fresh_depth, 0.0, 0.3);
  CheckRange("terrain.craters.oldest_depth", oldest_depth, 0.0, fresh_depth);
  for (const ExtraCrater& crater : extra) {
    CheckRange("terrain.craters.extra.x", crater.x, -1e5, 1e5);
    CheckRange("terrain.craters.extra.y", crater.y, -1e5, 1e5);
    CheckRange("terrain.craters.extra.diameter", crater.diameter, 0.2, 1000.0);
    CheckRange("terrain.craters.extra.depth", crater.depth, 0.0, 0.3);
  }
}

void RockOptions::Check() const {
  CheckRange("terrain.rocks.density", density, 0.0, 1.0);
  CheckRange("terrain.rocks.exponent", exponent, 1.0, 5.0);
  CheckRange("terrain.rocks.cover", cover, 0.001, 0.5);
  CheckRange("terrain.rocks.min_diameter", min_diameter, 0.05, 10.0);
  CheckRange("terrain.rocks.max_diameter", max_diameter, min_diameter, 20.0);
  CheckRange("terrain.rocks.clustering", clustering, 0.0, 1.0);
  CheckRange("terrain.rocks.height_share", height_share, 0.1, 1.0);
}

void ClodOptions::Check() const {
  CheckRange("terrain.clods.density", density, 0.0, 400.0);
  CheckRange("terrain.clods.exponent", exponent, 1.0, 5.0);
}

void RippleOptions::Check() const {
  CheckRange("terrain.ripples.wavelength", wavelength, 0.05, 1.0);
  CheckRange("terrain.ripples.height", height, 0.0, 0.12 * wavelength);
  CheckRange("terrain.ripples.mega_wavelength", mega_wavelength, 1.0, 10.0);
  CheckRange("terrain.ripples.mega_height", mega_height, 0.0, 0.12 * mega_wavelength);
  CheckRange("terrain.ripples.dune_wavelength", dune_wavelength, 10.0, 300.0);
  CheckRange("terrain.ripples.dune_height", dune_height, 0.0, 0.12 * dune_wavelength);
  CheckRange("terrain.ripples.cover", cover, 0.0, 1.0);
  CheckRange("terrain.ripples.direction_deg", direction_deg, -360.0, 360.0);
}

void AlbedoOptions::Check() const {
  CheckRange("terrain.albedo.mean", mean, 0.01, 0.9);
  CheckRange("terrain.albedo.contrast", contrast, 0.0, 1.0);
  CheckRange("terrain.albedo.grain", grain, 0.0, 0.5);
  CheckRange("terrain.albedo.patches", patches, 0.0, 0.5);
}

void TerrainOptions::Check() const {
  relief.Check();
  craters.Check();
  rocks.Check();
  clods.Check();
  ripples.Check();
  albedo.Check();
}

}  // namespace regolith
