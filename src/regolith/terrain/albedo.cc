// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/albedo.h"

#include <cmath>

namespace regolith {
namespace {

constexpr double kLongest = 32.0;  // m
constexpr double kPatch = 1.5;     // m: octaves above are patches: 2, 4, 8, 16, 32 m
constexpr int kPatchOctaves = 5;
constexpr double kGrain = 0.01;  // m: octaves below are grain; between lie those of the contrast
constexpr int kTextureOctaves = 7;
constexpr double kShortest = 32.0 / 4096.0;  // m: 7.8 mm
// A brightness is no height: posts carry it somewhat finer than two to a wave without harm.
constexpr double kWavelengthsPerPost = 1.5;

double OctaveContrast(const AlbedoOptions& options, double wavelength) {
  if (wavelength > kPatch) return options.patches / std::sqrt(kPatchOctaves);
  if (wavelength > kGrain) return options.contrast / std::sqrt(kTextureOctaves);
  return options.grain;
}

// e^x for |x| < 2 to 1e-6, of operations that vectorise.
template <typename Real>
Real Exponential(Real x) {
  const Real t = x * Real{0.0625};
  Real power = Real{1} + t * (Real{1} + t * (Real{0.5} + t * (Real{1} / Real{6} + t / Real{24})));
  for (int i = 0; i < 4; ++i) power *= power;
  return power;
}

}  // namespace

AlbedoField::AlbedoField(const AlbedoOptions& options, uint64_t seed)
    : mean_(options.mean), logarithm_(seed, kLongest, kShortest, [&](double wavelength) {
        return OctaveContrast(options, wavelength);
      }) {}

double AlbedoField::At(double x, double y, double spacing) const {
  return mean_ * Exponential(logarithm_.At(x, y, kWavelengthsPerPost * spacing));
}

void AlbedoField::Sample(const PostBlock& block, std::vector<float>* albedo) const {
  std::vector<double> logarithm(block.size(), 0.0);
  logarithm_.AddTo(block, kWavelengthsPerPost * block.spacing, logarithm.data());
  albedo->resize(block.size());
  for (size_t i = 0; i < logarithm.size(); ++i) {
    (*albedo)[i] = static_cast<float>(mean_ * Exponential(logarithm[i]));
  }
}

}  // namespace regolith
