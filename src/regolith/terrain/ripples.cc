// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/ripples.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr double kPostsAcross = 4.0;  // the second harmonic needs two
constexpr double kMeander = 0.8;      // rad, each of three octaves
constexpr double kPatchEdge = 0.7;    // standard deviations of the patches' noise
// cos θ + a cos 2θ + b sin 2θ: narrow crests, wide troughs, the lee side steeper than the stoss.
constexpr double kNarrow = 0.15;
constexpr double kLean = 0.2;
constexpr double kProfileRange = 2.13;  // its crest less its trough

// The value that a standard normal exceeds with this probability.
double NormalQuantile(double exceeded) {
  double low = -6.0;
  double high = 6.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > exceeded ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

RippleField::RippleField(const RippleOptions& options, uint64_t seed) {
  const double direction = options.direction_deg * M_PI / 180.0;
  const double turned = direction + 0.3;  // winds of different years
  AddLayer(options.wavelength, options.height, options.cover, direction, Scramble(seed));
  AddLayer(options.mega_wavelength, options.mega_height, options.cover, turned, Scramble(seed + 1));
  AddLayer(options.dune_wavelength, options.dune_height, 1.0, turned, Scramble(seed + 2));
}

void RippleField::AddLayer(double wavelength, double height, double cover, double direction,
                           uint64_t seed) {
  if (height <= 0.0 || cover <= 0.0) return;
  const Eigen::Vector2d number =
      2.0 * M_PI / wavelength * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  FractalNoise patches(seed, 32.0 * wavelength, 4.0 * wavelength, 0.5);
  patches.Scale(1.0 / patches.Sigma());
  layers_.push_back({wavelength, height, number, NormalQuantile(cover),
                     FractalNoise(Scramble(seed), 20.0 * wavelength, 5.0 * wavelength,
                                  [](double) { return kMeander; }),
                     patches});
}

double RippleField::LayerHeight(const Layer& layer, double phase, double patch) {
  // Half of the edge lies on either side of the patch's border; inside, the height swells on.
  const double t = std::clamp((patch - layer.threshold) / kPatchEdge + 0.5, 0.0, 1.0);
  if (t <= 0.0) return 0.0;
  const double cosine = std::cos(phase);
  const double sine = std::sin(phase);
  const double profile =
      cosine + kNarrow * (2.0 * cosine * cosine - 1.0) + kLean * 2.0 * sine * cosine;
  const double swell = 0.5 + 0.5 * std::clamp(0.5 + 0.25 * (patch - layer.threshold), 0.0, 1.0);
  return layer.height / kProfileRange * profile * swell * t * t * (3.0 - 2.0 * t);
}

double RippleField::Height(double x, double y, double spacing) const {
  double height = 0.0;
  for (const Layer& layer : layers_) {
    if (layer.wavelength < kPostsAcross * spacing) continue;
    const double phase = layer.number.dot(Eigen::Vector2d(x, y)) + layer.meander.At(x, y, 0.0);
    height += LayerHeight(layer, phase, layer.patches.At(x, y, 0.0));
  }
  return height;
}

void RippleField::AddTo(const PostBlock& block, double* heights) const {
  std::vector<double> meander(block.size());
  std::vector<double> patches(block.size());
  for (const Layer& layer : layers_) {
    if (layer.wavelength < kPostsAcross * block.spacing) continue;
    std::fill(meander.begin(), meander.end(), 0.0);
    std::fill(patches.begin(), patches.end(), 0.0);
    layer.meander.AddTo(block, 0.0, meander.data());
    layer.patches.AddTo(block, 0.0, patches.data());
    size_t k = 0;
    for (int j = 0; j < block.rows; ++j) {
      for (int i = 0; i < block.columns; ++i, ++k) {
        const Eigen::Vector2d place(block.x + i * block.spacing, block.y + j * block.spacing);
        heights[k] += LayerHeight(layer, layer.number.dot(place) + meander[k], patches[k]);
      }
    }
  }
}

}  // namespace regolith
