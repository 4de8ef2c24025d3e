// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Real elevation models, from the file to the ground that a rover stands on.
#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "regolith/config/install_paths.h"
#include "regolith/config/scenario_config.h"
#include "regolith/core/random.h"
#include "regolith/io/raster.h"
#include "regolith/io/test_folder.h"
#include "regolith/terrain/dem_quality.h"
#include "regolith/terrain/slope_statistics.h"
#include "regolith/terrain/surface.h"

namespace regolith {
namespace {

struct RealModel {
  const char* file;
  const char* scenario;
  size_t fewest_spikes;
  size_t most_spikes;
  double quantisation;  // m
  bool rows_tracked;    // the altimeter's tracks
  double finest;        // of the effective resolution, pixels
  double coarsest;
};

// Named by its file and scenario, not by the bytes of the struct.
void PrintTo(const RealModel& model, std::ostream* out) {
  *out << model.file << " in " << model.scenario;
}

const RealModel kModels[] = {
    {"moon_lola_88S_10m.tif", "lunar_short", 12, 40, 0.5, true, 2.0, 2.5},
    {"moon_lola_88S_10m.tif", "lunar_pole", 12, 40, 0.5, true, 2.0, 2.5},
    {"mars_gale_ctx_20m.tif", "mars_short", 0, 10, 0.0, false, 3.0, 6.0},
    {"marsyard_2021_0.094m.tif", "mars_short", 0, 10, 0.0, false, 2.0, 6.0},
};

class RealModels : public testing::TestWithParam<RealModel> {
 protected:
  void SetUp() override {
    const std::string path = DataFolder() + "/dem/" + GetParam().file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "NO REAL DATA: no " << path;
    grid_ = ReadHeights(path);
    options_ =
        LoadScenario(YamlDocument::FromFile(FindConfig("scenarios", GetParam().scenario))).terrain;
  }

  HeightGrid grid_;
  TerrainOptions options_;
};

// Second differences see waves about twice as long as the lag, and no slope.
double Roughness(const Surface& surface, SlopeStatistic statistic, double lag) {
  Random random(7);
  std::vector<double> differences;
  const Eigen::AlignedBox2d box = surface.box();
  while (differences.size() < 10000) {
    const double x = random.Uniform(box.min().x(), box.max().x());
    const double y = random.Uniform(box.min().y(), box.max().y());
    const double angle = random.Uniform(0.0, 2.0 * M_PI);
    if (!surface.Known(x, y, lag)) continue;
    const double dx = lag * std::cos(angle);
    const double dy = lag * std::sin(angle);
    differences.push_back(surface.Height(x + dx, y + dy, 0.0) +
                          surface.Height(x - dx, y - dy, 0.0) - 2.0 * surface.Height(x, y, 0.0));
  }
  return statistic == SlopeStatistic::kRms ? RootMeanSquare(differences)
                                           : MedianMagnitude(std::move(differences));
}

TEST_P(RealModels, AreAssessedWithoutFalseAlarms) {
  const DemQuality quality = AssessDem(grid_);
  EXPECT_GE(quality.spikes.size(), GetParam().fewest_spikes);
  EXPECT_LE(quality.spikes.size(), GetParam().most_spikes);
  EXPECT_NEAR(quality.quantisation, GetParam().quantisation, 1e-6);
  EXPECT_FALSE(quality.rows.striped || quality.columns.striped);
  EXPECT_EQ(quality.rows.tracked, GetParam().rows_tracked);
  EXPECT_GE(quality.effective_resolution, GetParam().finest * grid_.spacing);
  EXPECT_LE(quality.effective_resolution, GetParam().coarsest * grid_.spacing);
}

TEST_P(RealModels, GoOnBelowTheirResolutionWithoutAStepInTheSpectrum) {
  const auto surface = CreateDemSurface(grid_, options_, 1);
  const SurfaceReport report = surface->Report();
  const auto roughness = [&](double resolutions) {
    return std::log(
        Roughness(*surface, options_.relief.statistic, resolutions * report.effective_resolution));
  };
  const double low = roughness(0.125);
  const double high = roughness(4.0);
  for (int k = 1; k < 5; ++k) {
    const double trend = low + 0.2 * k * (high - low);
    const double factor = std::exp(std::abs(roughness(0.125 * std::exp2(k)) - trend));
    EXPECT_LT(factor, 2.0) << "over " << 0.125 * std::exp2(k) << " effective resolutions";
  }
}

TEST_P(RealModels, KeepTheSlopesOfTheScenarioOrSayThatTheyCannot) {
  const SurfaceReport report = CreateDemSurface(grid_, options_, 1)->Report();
  EXPECT_EQ(report.pixel, grid_.spacing);
  EXPECT_GE(report.hurst, 0.3);
  EXPECT_LE(report.hurst, 0.98);
  if (report.effective_resolution < 2.0) {
    EXPECT_EQ(report.hurst, options_.relief.hurst);
  } else if (report.hurst_clamped) {
    EXPECT_GE(report.slope_at_1m_deg, 0.99 * options_.relief.slope_deg);
  } else {
    EXPECT_NEAR(report.slope_at_1m_deg, options_.relief.slope_deg, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(All, RealModels, testing::ValuesIn(kModels));

}  // namespace
}  // namespace regolith
