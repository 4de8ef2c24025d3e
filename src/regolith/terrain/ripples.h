// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/terrain/fractal_noise.h"
#include "regolith/terrain/post_block.h"
#include "regolith/terrain/terrain_options.h"

namespace regolith {

/// Ripples, megaripples and dunes: asymmetric crests across the wind that meander, swell, end, and
/// keep to their patches.
class RippleField {
 public:
  RippleField(const RippleOptions& options, uint64_t seed);

  /// Height (m) at (x, y) m, of those that posts `spacing` m apart can carry.
  double Height(double x, double y, double spacing) const;

  /// Adds Height of every post of `block` to `heights`.
  void AddTo(const PostBlock& block, double* heights) const;

 private:
  struct Layer {
    double wavelength;       ///< m
    double height;           ///< m, trough to crest
    Eigen::Vector2d number;  ///< rad/m
    double threshold;        ///< of the patches, standard deviations
    FractalNoise meander;    ///< rad
    FractalNoise patches;    ///< standard deviations
  };
  void AddLayer(double wavelength, double height, double cover, double direction, uint64_t seed);
  static double LayerHeight(const Layer& layer, double phase, double patch);

  std::vector<Layer> layers_;
};

}  // namespace regolith
