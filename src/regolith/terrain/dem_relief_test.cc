// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/dem_relief.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "regolith/core/random.h"
#include "regolith/terrain/surface.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
const Eigen::AlignedBox2d kBox(Eigen::Vector2d(-300, -300), Eigen::Vector2d(300, 300));

// Posts of self-affine relief whose profiles have RMS slopes of `slope_deg` over 1 m.
HeightGrid SelfAffine(double spacing, double hurst, double slope_deg) {
  FractalNoise noise(3, 1024.0, 0.25 * spacing, hurst);
  FractalNoise fine(3, 1024.0, 0.05, hurst);
  const double deviation =
      RmsDeviation([&](double x, double y) { return fine.At(x, y, 0.0); }, kBox, 1.0, 20000);
  noise.Scale(std::tan(slope_deg * kDegree) / deviation);
  HeightGrid grid;
  grid.columns = grid.rows = static_cast<int>(1000.0 / spacing);
  grid.spacing = spacing;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      grid.heights.push_back(
          static_cast<float>(noise.At(column * spacing - 500.0, 500.0 - row * spacing, 0.0)));
    }
  }
  return grid;
}

TerrainOptions RmsOptions(double slope_deg) {
  TerrainOptions options;
  options.relief.statistic = SlopeStatistic::kRms;
  options.relief.slope_deg = slope_deg;
  options.craters.density = 0.0;
  return options;
}

// Second differences see waves about twice as long as the lag, and no slope.
double Roughness(const Surface& surface, double lag) {
  Random random(7);
  double sum = 0.0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double x = random.Uniform(-300.0, 300.0);
    const double y = random.Uniform(-300.0, 300.0);
    const double angle = random.Uniform(0.0, 2.0 * M_PI);
    const double dx = lag * std::cos(angle);
    const double dy = lag * std::sin(angle);
    sum += std::pow(surface.Height(x + dx, y + dy, 0.0) + surface.Height(x - dx, y - dy, 0.0) -
                        2.0 * surface.Height(x, y, 0.0),
                    2);
  }
  return std::sqrt(sum / count);
}

// The largest factor by which the roughness leaves the straight line, in logarithms, from a quarter
// of the effective resolution to four times it.
double SpectralStep(const Surface& surface) {
  const double resolution = surface.Report().effective_resolution;
  const double low = std::log(Roughness(surface, 0.125 * resolution));
  const double high = std::log(Roughness(surface, 4.0 * resolution));
  double step = 0.0;
  for (int k = 1; k < 5; ++k) {
    const double trend = low + 0.2 * k * (high - low);
    const double at = std::log(Roughness(surface, 0.125 * resolution * std::exp2(k)));
    step = std::max(step, std::abs(at - trend));
  }
  return std::exp(step);
}

double SlopeOverOneMetre(const Surface& surface) {
  return std::atan(RmsDeviation([&](double x, double y) { return surface.Height(x, y, 0.0); }, kBox,
                                1.0, 20000)) /
         kDegree;
}

TEST(DemRelief, FindsTheHurstExponentOfAModelThatFollowsTheStatistics) {
  for (const double hurst : {0.6, 0.76, 0.9}) {
    for (const double spacing : {2.0, 10.0}) {
      const auto surface = CreateDemSurface(SelfAffine(spacing, hurst, 5.0), RmsOptions(5.0), 5);
      const SurfaceReport report = surface->Report();
      EXPECT_NEAR(report.hurst, hurst, 0.06) << spacing << " m";
      EXPECT_FALSE(report.hurst_clamped);
      EXPECT_NEAR(report.slope_at_1m_deg, 5.0, 0.1);
      EXPECT_NEAR(SlopeOverOneMetre(*surface), 5.0, 0.3);
      EXPECT_LT(SpectralStep(*surface), 2.0);
    }
  }
}

TEST(DemRelief, KeepsTheSlopesOfTheStatisticsWhereTheModelAllows) {
  // Over 20 m the model is rougher or smoother than self-affine relief of its own exponent.
  for (const double slope : {3.0, 4.0, 7.0}) {
    const auto surface = CreateDemSurface(SelfAffine(10.0, 0.76, 5.0), RmsOptions(slope), 5);
    EXPECT_NEAR(SlopeOverOneMetre(*surface), slope, 0.06 * slope);
    EXPECT_LT(SpectralStep(*surface), 2.0);
  }
}

TEST(DemRelief, CountsCratersIn) {
  TerrainOptions options;
  options.relief.slope_deg = 3.4;
  const auto surface = CreateDemSurface(SelfAffine(5.0, 0.76, 5.0), options, 5);
  const HeightFunction height = [&](double x, double y) { return surface->Height(x, y, 0.0); };
  EXPECT_NEAR(MedianSlope(height, kBox, 1.0, 20000) / kDegree, 3.4, 0.3);
  EXPECT_LT(SpectralStep(*surface), 2.0);
}

TEST(DemRelief, LeavesAModelFinerThanOneMetreAlone) {
  HeightGrid fine = SelfAffine(2.0, 0.76, 5.0);
  fine.spacing = 0.1;
  for (float& height : fine.heights) height *= 0.1F;
  const auto surface = CreateDemSurface(fine, RmsOptions(1.0), 5);
  const SurfaceReport report = surface->Report();
  EXPECT_EQ(report.hurst, RmsOptions(1.0).relief.hurst);
  EXPECT_FALSE(report.hurst_clamped);
  const Dem dem(fine);
  const Eigen::AlignedBox2d box(Eigen::Vector2d(-20, -20), Eigen::Vector2d(20, 20));
  const double own =
      RmsDeviation([&](double x, double y) { return dem.Height(x, y); }, box, 1.0, 20000);
  EXPECT_NEAR(std::tan(report.slope_at_1m_deg * kDegree), own, 0.1 * own);
}

TEST(DemRelief, DoesNotAddRipplesThatTheModelShows) {
  TerrainOptions options = RmsOptions(5.0);
  options.ripples.dune_height = 2.0;
  options.ripples.dune_wavelength = 30.0;
  const HeightGrid grid = SelfAffine(2.0, 0.76, 5.0);
  const auto with = CreateDemSurface(grid, options, 5);
  options.ripples.dune_height = 0.0;
  const auto without = CreateDemSurface(grid, options, 5);
  EXPECT_EQ(with->Height(3.0, 4.0, 0.0), without->Height(3.0, 4.0, 0.0));
}

}  // namespace
}  // namespace regolith
