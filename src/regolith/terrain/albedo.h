// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/terrain/fractal_noise.h"
#include "regolith/terrain/post_block.h"
#include "regolith/terrain/terrain_options.h"

namespace regolith {

/// Normal albedo of the ground, log-normal about the mean with the same contrast in each octave of
/// patches (2-32 m), texture (1 cm to 1 m) and grain (below 1 cm).
class AlbedoField {
 public:
  AlbedoField(const AlbedoOptions& options, uint64_t seed);

  /// Normal albedo at (x, y) m, of what posts `spacing` m apart can carry; 0 gives all.
  double At(double x, double y, double spacing) const;

  /// At of every post of `block`.
  void Sample(const PostBlock& block, std::vector<float>* albedo) const;

 private:
  double mean_;
  FractalNoise logarithm_;
};

}  // namespace regolith
