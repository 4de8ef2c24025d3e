// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

/// Which figure of the slope distribution `ReliefOptions::slope_deg` is.
enum class SlopeStatistic { kMedian, kRms };

/// Self-affine relief: the RMS height difference over a distance L grows as L^hurst.
struct ReliefOptions {
  double hurst = 0.76;     ///< Hurst exponent (mare: Rosenburg et al. 2011)
  double slope_deg = 4.0;  ///< degrees, of profiles over 1 m, craters counted in
  SlopeStatistic statistic = SlopeStatistic::kMedian;
  double longest_wavelength = 128.0;   ///< m
  double shortest_wavelength = 0.032;  ///< m; finer relief belongs to the photometry

  /// Throws InputError that names the key.
  void Check() const;
};

/// Small craters in their steady state: N(> D) = density / D² a m².
struct CraterOptions {
  double density = 0.079;       ///< equilibrium of the maria (Trask 1966)
  double min_diameter = 0.2;    ///< m
  double max_diameter = 20.0;   ///< m
  double fresh_depth = 0.13;    ///< depth / diameter of the freshest
  double oldest_depth = 0.015;  ///< depth / diameter of those about to vanish

  /// Throws InputError that names the key.
  void Check() const;
};

/// Brightness of the ground: log-normal contrast on the scales between the two wavelengths.
struct AlbedoOptions {
  double mean = 0.12;                 ///< normal albedo
  double contrast = 0.06;             ///< standard deviation of its logarithm
  double shortest_wavelength = 0.01;  ///< m
  double longest_wavelength = 1.0;    ///< m

  /// Throws InputError that names the key.
  void Check() const;
};

/// What makes a terrain, whether generated or added below the pixels of an elevation model.
struct TerrainOptions {
  ReliefOptions relief;
  CraterOptions craters;
  AlbedoOptions albedo;

  void Check() const;
};

}  // namespace regolith
