// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace regolith {

/// Which figure of the slope distribution `ReliefOptions::slope_deg` is.
enum class SlopeStatistic { kMedian, kRms };

/// Self-affine relief: the RMS height difference over a distance L grows as L^hurst.
struct ReliefOptions {
  double hurst = 0.76;     ///< Hurst exponent (mare: Rosenburg et al. 2011)
  double slope_deg = 4.0;  ///< degrees, of profiles over 1 m, craters and ripples counted in
  SlopeStatistic statistic = SlopeStatistic::kMedian;
  double longest_wavelength = 1024.0;  ///< m
  double shortest_wavelength = 0.01;   ///< m; finer relief belongs to the photometry

  /// Throws InputError that names the key.
  void Check() const;
};

/// A crater that stands where the options say, whatever the seed.
struct ExtraCrater {
  double x = 0.0;         ///< m, of its centre, frame `map`
  double y = 0.0;         ///< m
  double diameter = 1.0;  ///< m, rim to rim
  double depth = 0.1;     ///< depth / diameter, rim crest to floor
};

/// Craters in their steady state, N(> D) = density / D² a m² up to the diameter to which the
/// surface is in equilibrium; wider ones are rarer, as they are produced.
struct CraterOptions {
  double density = 0.079;              ///< equilibrium of the maria (Trask 1966)
  double min_diameter = 0.2;           ///< m
  double max_diameter = 200.0;         ///< m
  double equilibrium_diameter = 20.0;  ///< m; wider craters follow N(> D) ~ D^-3
  double fresh_depth = 0.12;           ///< depth / diameter of the freshest, 30-100 m (Stopar 2017)
  double oldest_depth = 0.035;         ///< depth / diameter of those about to vanish
  std::vector<ExtraCrater> extra;

  /// Throws InputError that names the key.
  void Check() const;
};

/// How the number of rocks wider than D falls with D.
enum class RockLaw { kNone, kPower, kGolombek };

/// Rocks that lie on the ground, as meshes.
struct RockOptions {
  RockLaw law = RockLaw::kPower;
  double density = 0.03;       ///< power law: rocks > 0.25 m a m² (Surveyor; NASA 1969)
  double exponent = 2.1;       ///< power law: N(> D) ~ D^-exponent (Surveyor I: 2.11)
  double cover = 0.05;         ///< Golombek and Rapp 1997: k, the share of the area under rocks
  double min_diameter = 0.05;  ///< m
  double max_diameter = 2.0;   ///< m
  double clustering = 0.6;     ///< share of the rocks that lie as ejecta around fresh craters
  double height_share = 0.5;   ///< mean height above ground / diameter (NASA 1969: half)

  /// Throws InputError that names the key.
  void Check() const;
};

/// Fragments and clods too small for meshes, 1-5 cm: bumps of the ground itself.
struct ClodOptions {
  double density = 40.0;  ///< wider than 1 cm, a m² (Surveyor I: 39)
  double exponent = 2.1;  ///< N(> D) ~ D^-exponent, as the rocks' law

  /// Throws InputError that names the key.
  void Check() const;
};

/// Sand shaped by wind: ripples everywhere, megaripples in patches, dunes. A height of 0 leaves a
/// kind out. Heights are from trough to crest.
struct RippleOptions {
  double wavelength = 0.2;        ///< m
  double height = 0.0;            ///< m
  double mega_wavelength = 3.0;   ///< m
  double mega_height = 0.0;       ///< m
  double dune_wavelength = 30.0;  ///< m
  double dune_height = 0.0;       ///< m
  double cover = 0.4;             ///< share of the ground in patches of ripples and megaripples
  double direction_deg = 30.0;    ///< degrees, of the wind: across the crests, east to north

  /// Throws InputError that names the key.
  void Check() const;
};

/// Brightness of the ground: log-normal. `contrast` is what its scales from 1 cm to 1 m have.
struct AlbedoOptions {
  double mean = 0.12;      ///< normal albedo (mare .11-.13: Sato et al. 2014)
  double contrast = 0.06;  ///< standard deviation of its logarithm from 1 cm to 1 m
  double grain = 0.03;     ///< likewise of mineral grain finer than 1 cm
  double patches = 0.02;   ///< likewise of patches of 2 to 32 m

  /// Throws InputError that names the key.
  void Check() const;
};

/// What makes a terrain, whether generated or added below the pixels of an elevation model.
struct TerrainOptions {
  ReliefOptions relief;
  CraterOptions craters;
  RockOptions rocks;
  ClodOptions clods;
  RippleOptions ripples;
  AlbedoOptions albedo;

  void Check() const;
};

}  // namespace regolith
