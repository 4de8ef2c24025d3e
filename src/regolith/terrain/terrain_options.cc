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
  CheckRange("terrain.craters.fresh_depth", fresh_depth, 0.0, 0.3);
  CheckRange("terrain.craters.oldest_depth", oldest_depth, 0.0, fresh_depth);
}

void AlbedoOptions::Check() const {
  CheckRange("terrain.albedo.mean", mean, 0.01, 0.9);
  CheckRange("terrain.albedo.contrast", contrast, 0.0, 1.0);
  CheckRange("terrain.albedo.shortest_wavelength", shortest_wavelength, 0.002, 1.0);
  CheckRange("terrain.albedo.longest_wavelength", longest_wavelength, shortest_wavelength, 100.0);
}

void TerrainOptions::Check() const {
  relief.Check();
  craters.Check();
  albedo.Check();
}

}  // namespace regolith
