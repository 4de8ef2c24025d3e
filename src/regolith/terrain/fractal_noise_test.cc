// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/fractal_noise.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "regolith/core/random.h"
#include "regolith/terrain/albedo.h"
#include "regolith/terrain/gradient_noise.h"
#include "regolith/terrain/slope_statistics.h"

namespace regolith {
namespace {

TEST(GradientNoise, HasTheStatedSpread) {
  Random random(3);
  double sum = 0.0;
  double squares = 0.0;
  const int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double value =
        GradientNoise(5, random.Uniform(-500.0, 500.0), random.Uniform(-500.0, 500.0));
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.005);
  EXPECT_NEAR(std::sqrt(squares / count), kGradientNoiseSigma, 0.01 * kGradientNoiseSigma);
}

TEST(GradientNoise, IsSmoothAcrossItsLattice) {
  const double step = 1e-5;
  for (const double y : {0.3, 1.0, 2.7}) {
    const double left = (GradientNoise(5, 3.0, y) - GradientNoise(5, 3.0 - step, y)) / step;
    const double right = (GradientNoise(5, 3.0 + step, y) - GradientNoise(5, 3.0, y)) / step;
    EXPECT_NEAR(left, right, 1e-3);
  }
}

TEST(FractalNoise, HasTheHurstExponentAskedFor) {
  for (const double hurst : {0.55, 0.76, 0.9}) {
    const FractalNoise noise(7, 512.0, 0.03, hurst);
    const HeightFunction height = [&](double x, double y) { return noise.At(x, y, 0.0); };
    const Eigen::AlignedBox2d box(Eigen::Vector2d(0, 0), Eigen::Vector2d(4000, 4000));
    EXPECT_NEAR(HurstExponent(height, box, 0.25, 8.0, 20000), hurst, 0.05) << hurst;
  }
}

TEST(FractalNoise, GivesBlocksWhatItGivesPosts) {
  const FractalNoise noise(7, 1024.0, 0.01, 0.76);
  for (const double spacing : {0.005, 0.32, 20.0}) {
    const PostBlock block{-311.0, 178.0, spacing, 200, 5};
    std::vector<double> values(block.size(), 0.0);
    noise.AddTo(block, 2.0 * spacing, values.data());
    for (size_t k = 0; k < values.size(); ++k) {
      const double x = block.x + static_cast<double>(k % 200) * spacing;
      const double y = block.y + static_cast<double>(k / 200) * spacing;
      EXPECT_NEAR(values[k], noise.At(x, y, 2.0 * spacing), 2e-4) << spacing;
    }
  }
}

double LogarithmSigma(const AlbedoOptions& options) {
  const AlbedoField field(options, 11);
  Random random(2);
  double squares = 0.0;
  const int count = 50000;
  for (int i = 0; i < count; ++i) {
    const double value = std::log(
        field.At(random.Uniform(0.0, 900.0), random.Uniform(0.0, 900.0), 0.0) / options.mean);
    squares += value * value;
  }
  return std::sqrt(squares / count);
}

TEST(AlbedoField, HasTheContrastAskedForFromOneCentimetreToOneMetre) {
  AlbedoOptions options;
  options.contrast = 0.12;
  options.grain = 0.0;
  options.patches = 0.0;
  EXPECT_NEAR(LogarithmSigma(options), 0.12, 0.004);
  options.grain = 0.05;
  EXPECT_NEAR(LogarithmSigma(options), std::hypot(0.12, 0.05), 0.004);
  options.patches = 0.06;
  EXPECT_NEAR(LogarithmSigma(options), std::hypot(std::hypot(0.12, 0.05), 0.06), 0.005);
}

}  // namespace
}  // namespace regolith
