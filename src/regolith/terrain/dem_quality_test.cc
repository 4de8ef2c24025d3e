// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/dem_quality.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "regolith/core/random.h"
#include "regolith/terrain/effective_resolution.h"
#include "regolith/terrain/fractal_noise.h"

namespace regolith {
namespace {

constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

// Self-affine relief of waves no shorter than `shortest` m, RMS deviation about 0.1 m at 1 m.
HeightGrid SelfAffine(int size, double spacing, double hurst, double shortest) {
  FractalNoise noise(3, 256.0 * spacing, shortest, hurst);
  noise.Scale(0.06);
  HeightGrid grid;
  grid.columns = grid.rows = size;
  grid.spacing = spacing;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      grid.heights.push_back(
          static_cast<float>(noise.At(column * spacing + 0.3, row * spacing + 0.7, 0.0)));
    }
  }
  return grid;
}

HeightGrid Rough(int size) { return SelfAffine(size, 2.0, 0.76, 1.0); }

double RmsDifference(const HeightGrid& one, const HeightGrid& other) {
  double sum = 0.0;
  for (size_t i = 0; i < one.heights.size(); ++i) {
    sum += std::pow(static_cast<double>(one.heights[i] - other.heights[i]), 2);
  }
  return std::sqrt(sum / static_cast<double>(one.heights.size()));
}

HeightGrid WithStripes(HeightGrid grid, double sigma, bool columns) {
  Random random(5);
  for (int line = 0; line < grid.rows; ++line) {
    const auto offset = static_cast<float>(random.Gaussian(0.0, sigma));
    for (int along = 0; along < grid.columns; ++along) {
      (columns ? grid.At(line, along) : grid.At(along, line)) += offset;
    }
  }
  return grid;
}

TEST(DemQuality, FindsNothingWrongWithReliefAlone) {
  const DemQuality quality = AssessDem(Rough(256));
  EXPECT_EQ(quality.posts, 65536U);
  EXPECT_EQ(quality.no_data, 0U);
  EXPECT_LE(quality.spikes.size(), 1U);
  for (const Stripes& stripes : {quality.rows, quality.columns}) {
    EXPECT_FALSE(stripes.striped || stripes.tracked);
  }
  EXPECT_EQ(quality.quantisation, 0.0);
}

TEST(DemQuality, FindsEachSpikeAndTakesItOut) {
  const HeightGrid clean = Rough(256);
  HeightGrid grid = clean;
  std::vector<size_t> places;
  for (int k = 0; k < 25; ++k) {
    const int column = 7 + 9 * k;
    const int row = 11 + (53 * k) % 230;
    grid.At(column, row) += k % 2 == 0 ? 6.0F : -6.0F;
    places.push_back(static_cast<size_t>(row) * 256 + static_cast<size_t>(column));
  }
  const DemQuality quality = AssessDem(grid);
  EXPECT_LE(quality.spikes.size(), places.size() + 1);
  for (const size_t place : places) {
    EXPECT_TRUE(std::count(quality.spikes.begin(), quality.spikes.end(), place) == 1) << place;
  }
  const HeightGrid repaired = Repaired(grid, quality);
  for (const size_t place : places) {
    EXPECT_NEAR(repaired.heights[place], clean.heights[place], 0.8F);
  }
  EXPECT_LT(RmsDifference(repaired, clean), 0.01);
}

TEST(DemQuality, DoesNotTakeCliffsAndSummitsForSpikes) {
  HeightGrid grid = Rough(256);
  for (int row = 0; row < 256; ++row) {
    for (int column = 0; column < 256; ++column) {
      if (column > 100 + row / 9) grid.At(column, row) += 40.0F;
      const double distance = std::hypot(column - 60, row - 80);
      grid.At(column, row) += static_cast<float>(std::max(0.0, 10.0 - 2.0 * distance));
    }
  }
  EXPECT_LE(AssessDem(grid).spikes.size(), 2U);
}

TEST(DemQuality, MeasuresStripesOfRowsAndOfColumns) {
  for (const bool columns : {false, true}) {
    const HeightGrid clean = Rough(256);
    const HeightGrid grid = WithStripes(clean, 0.1, columns);
    const DemQuality quality = AssessDem(grid);
    EXPECT_EQ(quality.rows.striped, !columns);
    EXPECT_EQ(quality.columns.striped, columns);
    EXPECT_NEAR((columns ? quality.columns : quality.rows).offsets, 0.1, 0.02);
    const HeightGrid repaired = Repaired(grid, quality);
    EXPECT_LT(RmsDifference(repaired, clean), 0.7 * RmsDifference(grid, clean));
    const DemQuality after = AssessDem(repaired);
    EXPECT_LT((columns ? after.columns : after.rows).offsets, 0.04);
  }
}

TEST(DemQuality, FindsRoughTracksAndSmoothsThem) {
  for (const bool columns : {false, true}) {
    const HeightGrid clean = Rough(256);
    HeightGrid grid = clean;
    Random random(6);
    for (int line = 12; line < 250; line += 24) {
      for (int along = 0; along < 256; ++along) {
        (columns ? grid.At(line, along) : grid.At(along, line)) +=
            static_cast<float>(random.Gaussian(0.0, 0.8));
      }
    }
    const DemQuality quality = AssessDem(grid);
    EXPECT_EQ(quality.rows.tracked, !columns);
    EXPECT_EQ(quality.columns.tracked, columns);
    EXPECT_FALSE(quality.rows.striped || quality.columns.striped);
    const HeightGrid repaired = Repaired(grid, quality);
    EXPECT_LT(RmsDifference(repaired, clean), 0.5 * RmsDifference(grid, clean));
  }
}

TEST(DemQuality, FindsTheStepOfCoarseHeightsOnly) {
  HeightGrid coarse = Rough(256);
  HeightGrid fine = coarse;
  for (float& height : coarse.heights) height = 0.1F * std::round(height / 0.1F);
  for (float& height : fine.heights) height = 0.001F * std::round(height / 0.001F);
  EXPECT_NEAR(AssessDem(coarse).quantisation, 0.1, 1e-4);
  EXPECT_EQ(AssessDem(fine).quantisation, 0.0);
}

TEST(DemQuality, FillsHolesLikeAMembrane) {
  HeightGrid grid = Rough(128);
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column) {
      grid.At(column, row) = static_cast<float>(0.2 * column - 0.1 * row);
    }
  }
  const HeightGrid plane = grid;
  for (int row = 30; row < 90; ++row) {
    for (int column = 40; column < 100; ++column) grid.At(column, row) = kHole;
  }
  const DemQuality quality = AssessDem(grid);
  EXPECT_EQ(quality.no_data, 3600U);
  const HeightGrid repaired = Repaired(grid, quality);
  // A plane solves Laplace's equation; what the sweeps have not reached is left.
  for (size_t i = 0; i < plane.heights.size(); ++i) {
    ASSERT_NEAR(repaired.heights[i], plane.heights[i], 0.1F) << i;
  }
}

TEST(EffectiveResolution, IsTwoPostsWhereReliefGoesDownToThem) {
  for (const double hurst : {0.5, 0.76, 0.95}) {
    EXPECT_NEAR(EffectiveResolution(SelfAffine(256, 2.0, hurst, 0.5)), 4.0, 0.5) << hurst;
  }
}

TEST(EffectiveResolution, IsThatOfTheCoarserModelWhichWasInterpolated) {
  const HeightGrid coarse = Rough(128);
  HeightGrid fine;
  constexpr int kFactor = 4;
  fine.columns = fine.rows = 127 * kFactor;
  fine.spacing = coarse.spacing / kFactor;
  for (int row = 0; row < fine.rows; ++row) {
    for (int column = 0; column < fine.columns; ++column) {
      const int i = column / kFactor;
      const int j = row / kFactor;
      const float u = static_cast<float>(column % kFactor) / kFactor;
      const float v = static_cast<float>(row % kFactor) / kFactor;
      const float north = (1 - u) * coarse.At(i, j) + u * coarse.At(i + 1, j);
      const float south = (1 - u) * coarse.At(i, j + 1) + u * coarse.At(i + 1, j + 1);
      fine.heights.push_back((1 - v) * north + v * south);
    }
  }
  EXPECT_NEAR(EffectiveResolution(fine), 2.0 * coarse.spacing, 1.0);
}

TEST(DemQuality, IsCheapForTheLargestModel) {
  HeightGrid grid;
  grid.columns = grid.rows = 2500;
  Random random(1);
  for (int i = 0; i < 2500 * 2500; ++i)
    grid.heights.push_back(static_cast<float>(random.Uniform()));
  const auto start = std::chrono::steady_clock::now();
  const DemQuality quality = AssessDem(grid);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(quality.posts, grid.heights.size());
  EXPECT_LT(seconds.count(), 10.0);
}

}  // namespace
}  // namespace regolith
