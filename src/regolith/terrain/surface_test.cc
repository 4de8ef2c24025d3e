// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/surface.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/terrain/slope_statistics.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;

const Eigen::AlignedBox2d kBox(Eigen::Vector2d(-100, -100), Eigen::Vector2d(100, 100));

HeightFunction HeightOf(const Surface& surface) {
  return [&surface](double x, double y) { return surface.Height(x, y, 0.0); };
}

TEST(GeneratedSurface, HasTheMedianSlopeWithCratersCountedIn) {
  const auto surface = CreateGeneratedSurface(TerrainOptions{}, 5, kBox);
  const double slope = MedianSlope(HeightOf(*surface), kBox, 1.0, 30000) / kDegree;
  EXPECT_NEAR(slope, 4.0, 0.25);
}

TEST(GeneratedSurface, HasTheRmsSlopeOfMars) {
  TerrainOptions options;
  options.relief.hurst = 0.6;
  options.relief.slope_deg = 5.0;
  options.relief.statistic = SlopeStatistic::kRms;
  options.craters.density = 0.016;
  const auto surface = CreateGeneratedSurface(options, 5, kBox);
  const double slope = std::atan(RmsDeviation(HeightOf(*surface), kBox, 1.0, 30000)) / kDegree;
  EXPECT_NEAR(slope, 5.0, 0.3);
}

TEST(GeneratedSurface, KeepsTheHurstExponentOfTheSum) {
  const auto surface = CreateGeneratedSurface(TerrainOptions{}, 5, kBox);
  EXPECT_NEAR(HurstExponent(HeightOf(*surface), kBox, 0.25, 4.0, 30000), 0.76, 0.1);
}

TEST(GeneratedSurface, DiffersBetweenSeedsAndNotBetweenRuns) {
  const auto first = CreateGeneratedSurface(TerrainOptions{}, 5, kBox);
  const auto again = CreateGeneratedSurface(TerrainOptions{}, 5, kBox);
  const auto other = CreateGeneratedSurface(TerrainOptions{}, 6, kBox);
  EXPECT_EQ(first->Height(3.1, 4.1, 0.0), again->Height(3.1, 4.1, 0.0));
  EXPECT_NE(first->Height(3.1, 4.1, 0.0), other->Height(3.1, 4.1, 0.0));
  EXPECT_NE(first->Albedo(3.1, 4.1, 0.0), other->Albedo(3.1, 4.1, 0.0));
}

TEST(GeneratedSurface, RefusesStatisticsThatMakeNoGround) {
  TerrainOptions options;
  options.relief.hurst = 3.0;
  EXPECT_THROW(CreateGeneratedSurface(options, 1, kBox), InputError);
}

TEST(DemSurface, AddsReliefOnlyBelowThePixel) {
  HeightGrid dem;
  dem.columns = 40;
  dem.rows = 40;
  dem.spacing = 5.0;
  dem.heights.assign(1600, 100.0F);
  TerrainOptions options;
  options.craters.density = 0.0;
  const auto surface = CreateDemSurface(dem, options, 5);
  const auto generated = CreateGeneratedSurface(options, 5, kBox);
  const Eigen::AlignedBox2d box(Eigen::Vector2d(-60, -60), Eigen::Vector2d(60, 60));
  EXPECT_NEAR(MedianSlope(HeightOf(*surface), box, 1.0, 20000) / kDegree, 4.0, 0.3);
  EXPECT_TRUE(surface->Report().hurst_clamped);
  EXPECT_LT(RmsDeviation(HeightOf(*surface), box, 40.0, 20000),
            0.5 * RmsDeviation(HeightOf(*generated), box, 40.0, 20000));
}

TEST(GeneratedSurface, SamplesBlocksAsItDoesPosts) {
  const auto surface = CreateGeneratedSurface(TerrainOptions{}, 5, kBox);
  for (const double spacing : {0.005, 0.04, 5.12}) {
    const PostBlock block{-3.0, 2.0, spacing, 129, 129};
    std::vector<double> heights;
    std::vector<float> albedo;
    surface->Sample(block, &heights, &albedo);
    for (size_t k = 0; k < heights.size(); k += 31) {
      const double x = block.x + static_cast<double>(k % 129) * spacing;
      const double y = block.y + static_cast<double>(k / 129) * spacing;
      EXPECT_NEAR(heights[k], surface->Height(x, y, spacing), 1e-5) << spacing;
      EXPECT_NEAR(albedo[k], surface->Albedo(x, y, spacing), 1e-4) << spacing;
    }
  }
}

TEST(GeneratedSurface, LaysRocksOnTheGround) {
  const auto surface = CreateGeneratedSurface(TerrainOptions{}, 5, kBox);
  const std::vector<Rock> rocks =
      surface->Rocks({Eigen::Vector2d(-5, -5), Eigen::Vector2d(5, 5)}, 0.1);
  ASSERT_GT(rocks.size(), 5U);
  const size_t shapes = surface->RockShapes().size();
  for (const Rock& rock : rocks) {
    EXPECT_EQ(rock.ground, surface->Height(rock.centre.x(), rock.centre.y(), 0.0));
    EXPECT_LT(rock.shape, shapes);
  }
}

TEST(DemSurface, SamplesBlocksAsItDoesPosts) {
  HeightGrid dem;
  dem.columns = 50;
  dem.rows = 40;
  dem.spacing = 2.0;
  for (int k = 0; k < 2000; ++k) dem.heights.push_back(static_cast<float>(std::sin(0.37 * k)));
  const auto surface = CreateDemSurface(dem, TerrainOptions{}, 5);
  for (const double spacing : {0.005, 0.32, 2.56}) {
    const PostBlock block{-47.0, 20.0, spacing, 60, 60};
    std::vector<double> heights;
    std::vector<float> albedo;
    surface->Sample(block, &heights, &albedo);
    for (size_t k = 0; k < heights.size(); k += 7) {
      const double x = block.x + static_cast<double>(k % 60) * spacing;
      const double y = block.y + static_cast<double>(k / 60) * spacing;
      EXPECT_NEAR(heights[k], surface->Height(x, y, spacing), 1e-5) << spacing;
    }
  }
}

TEST(SampleSurface, IsTheTopOfTheRocks) {
  const auto surface = CreateGeneratedSurface(TerrainOptions{}, 5, kBox);
  const Eigen::AlignedBox2d box(Eigen::Vector2d(-5, -5), Eigen::Vector2d(5, 5));
  const HeightGrid grid = SampleSurface(*surface, box, 0.05, Eigen::Vector3d::Zero());
  for (const Rock& rock : surface->Rocks(box, 0.3)) {
    const auto column = static_cast<int>(std::lround((rock.centre.x() + 5.0) / 0.05));
    const auto row = static_cast<int>(std::lround((5.0 - rock.centre.y()) / 0.05));
    EXPECT_GT(grid.At(column, row), rock.ground + 0.2 * rock.diameter);
  }
}

TEST(SampleSurface, IsNorthUpAndShifted) {
  const auto surface = CreateGeneratedSurface(TerrainOptions{}, 5, kBox);
  const Eigen::AlignedBox2d box(Eigen::Vector2d(1, 2), Eigen::Vector2d(4, 4));
  const HeightGrid grid = SampleSurface(*surface, box, 0.5, Eigen::Vector3d(1, 1, 0.2));
  EXPECT_EQ(grid.columns, 7);
  EXPECT_EQ(grid.rows, 5);
  EXPECT_DOUBLE_EQ(grid.origin.x(), 0.0);
  EXPECT_DOUBLE_EQ(grid.origin.y(), 3.0);
  EXPECT_FLOAT_EQ(grid.At(2, 1), static_cast<float>(surface->Height(2.0, 3.5, 0.5) - 0.2));
}

}  // namespace
}  // namespace regolith
