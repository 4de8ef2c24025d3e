// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/surface.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"
#include "regolith/terrain/albedo.h"
#include "regolith/terrain/clods.h"
#include "regolith/terrain/craters.h"
#include "regolith/terrain/dem.h"
#include "regolith/terrain/dem_relief.h"
#include "regolith/terrain/effective_resolution.h"
#include "regolith/terrain/fractal_noise.h"
#include "regolith/terrain/ripples.h"
#include "regolith/terrain/rock_shapes.h"
#include "regolith/terrain/rocks.h"
#include "regolith/terrain/search_box.h"
#include "regolith/terrain/slope_statistics.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr int kFitSamples = 30000;
constexpr double kFitSpacing = 0.05;  // m
// Posts carry waves from twice their spacing on, and craters that span four of them.
constexpr double kWavelengthsPerPost = 2.0;
constexpr double kCraterPosts = 4.0;
// A mesh reaches beyond the box of the path.
constexpr double kSurroundings = 3000.0;  // m

// Relief and craters of the statistics, scaled together.
class Statistical {
 public:
  Statistical(const TerrainOptions& options, uint64_t seed, const Eigen::AlignedBox2d& box)
      : relief_(StreamSeed(seed, "relief"), options.relief.longest_wavelength,
                options.relief.shortest_wavelength, options.relief.hurst),
        craters_(options.craters, StreamSeed(seed, "craters"), box, kSurroundings),
        ripples_(options.ripples, StreamSeed(seed, "ripples")),
        clods_(options.clods, StreamSeed(seed, "clods")) {
    FitRelief(options.relief, box);
  }

  double Relief(double x, double y, double spacing) const {
    return relief_.At(x, y, kWavelengthsPerPost * spacing);
  }
  double Height(double x, double y, double spacing) const {
    return Relief(x, y, spacing) + craters_.Height(x, y, kCraterPosts * spacing) +
           ripples_.Height(x, y, spacing) + clods_.Height(x, y, spacing);
  }
  void AddTo(const PostBlock& block, double* heights) const {
    relief_.AddTo(block, kWavelengthsPerPost * block.spacing, heights);
    craters_.AddTo(block, kCraterPosts * block.spacing, heights);
    ripples_.AddTo(block, heights);
    clods_.AddTo(block, heights);
  }
  const CraterField& craters() const { return craters_; }

 private:
  // Craters are part of the measured slopes: the relief gets what they leave. The figure grows
  // with the scale, so bisection finds it.
  void FitRelief(const ReliefOptions& options, const Eigen::AlignedBox2d& box) {
    const HeightFunction shaped = [this](double x, double y) {
      return craters_.Height(x, y, kCraterPosts * kFitSpacing) + ripples_.Height(x, y, kFitSpacing);
    };
    const HeightFunction rough = [this](double x, double y) { return Relief(x, y, kFitSpacing); };
    const std::vector<double> given = HeightDifferences(shaped, box, 1.0, kFitSamples);
    const std::vector<double> scaled = HeightDifferences(rough, box, 1.0, kFitSamples);
    const double target = std::tan(options.slope_deg * kDegree);
    double low = 0.0;
    double high = 4.0 * target;
    for (int i = 0; i < 24; ++i) {
      const double scale = 0.5 * (low + high);
      std::vector<double> sum = given;
      for (size_t k = 0; k < sum.size(); ++k) sum[k] += scale * scaled[k];
      const double figure = options.statistic == SlopeStatistic::kRms
                                ? RootMeanSquare(sum)
                                : MedianMagnitude(std::move(sum));
      (figure > target ? high : low) = scale;
    }
    relief_.Scale(0.5 * (low + high));
  }

  FractalNoise relief_;
  CraterField craters_;
  RippleField ripples_;
  ClodField clods_;
};

std::vector<Rock> OnGround(std::vector<Rock> rocks, const Surface& surface) {
  for (Rock& rock : rocks) rock.ground = surface.Height(rock.centre.x(), rock.centre.y(), 0.0);
  return rocks;
}

class GeneratedSurface : public Surface {
 public:
  GeneratedSurface(const TerrainOptions& options, uint64_t seed, const Eigen::AlignedBox2d& box)
      : box_(box),
        report_{options.relief.hurst, options.relief.slope_deg, 0.0, 0.0, false},
        statistical_(options, seed, box),
        albedo_(options.albedo, StreamSeed(seed, "albedo")),
        rocks_(options.rocks, StreamSeed(seed, "rocks"), statistical_.craters(), box),
        rock_shapes_(MakeRockShapes(options.rocks.height_share)) {}

  double Height(double x, double y, double spacing) const override {
    return statistical_.Height(x, y, spacing);
  }
  double Albedo(double x, double y, double spacing) const override {
    return albedo_.At(x, y, spacing);
  }
  void Sample(const PostBlock& block, std::vector<double>* heights,
              std::vector<float>* albedo) const override {
    heights->assign(block.size(), 0.0);
    statistical_.AddTo(block, heights->data());
    albedo_.Sample(block, albedo);
  }
  std::vector<Rock> Rocks(const Eigen::AlignedBox2d& area, double min_diameter) const override {
    return OnGround(rocks_.Rocks(area, min_diameter), *this);
  }
  std::vector<RockShape> RockShapes() const override { return rock_shapes_; }
  bool Known(double x, double y, double margin) const override {
    return box_.contains(Eigen::AlignedBox2d(Eigen::Vector2d(x - margin, y - margin),
                                             Eigen::Vector2d(x + margin, y + margin)));
  }
  Eigen::AlignedBox2d box() const override { return box_; }
  SurfaceReport Report() const override { return report_; }

 private:
  Eigen::AlignedBox2d box_;
  SurfaceReport report_;
  Statistical statistical_;
  AlbedoField albedo_;
  RockField rocks_;
  std::vector<RockShape> rock_shapes_;
};

// What is wider than the model's effective resolution stands in the model already.
CraterOptions Below(CraterOptions options, double resolution) {
  options.max_diameter = std::min(options.max_diameter, resolution);
  if (options.max_diameter <= options.min_diameter) options.density = 0.0;
  return options;
}

RippleOptions Below(RippleOptions options, double resolution) {
  if (options.wavelength >= resolution) options.height = 0.0;
  if (options.mega_wavelength >= resolution) options.mega_height = 0.0;
  if (options.dune_wavelength >= resolution) options.dune_height = 0.0;
  return options;
}

class DemSurface : public Surface {
 public:
  DemSurface(const HeightGrid& dem, const TerrainOptions& options, uint64_t seed)
      : DemSurface(dem, options, seed, EffectiveResolution(dem)) {}

  double Height(double x, double y, double spacing) const override {
    return dem_.Height(x, y) + relief_.noise.At(x, y, kWavelengthsPerPost * spacing) +
           craters_.Height(x, y, kCraterPosts * spacing) + ripples_.Height(x, y, spacing) +
           clods_.Height(x, y, spacing);
  }
  double Albedo(double x, double y, double spacing) const override {
    return albedo_.At(x, y, spacing);
  }
  void Sample(const PostBlock& block, std::vector<double>* heights,
              std::vector<float>* albedo) const override {
    heights->assign(block.size(), 0.0);
    dem_.AddTo(block, heights->data());
    relief_.noise.AddTo(block, kWavelengthsPerPost * block.spacing, heights->data());
    craters_.AddTo(block, kCraterPosts * block.spacing, heights->data());
    ripples_.AddTo(block, heights->data());
    clods_.AddTo(block, heights->data());
    albedo_.Sample(block, albedo);
  }
  std::vector<Rock> Rocks(const Eigen::AlignedBox2d& area, double min_diameter) const override {
    return OnGround(rocks_.Rocks(area, min_diameter), *this);
  }
  std::vector<RockShape> RockShapes() const override { return rock_shapes_; }
  bool Known(double x, double y, double margin) const override {
    return dem_.HasData(x, y, margin);
  }
  Eigen::AlignedBox2d box() const override { return box_; }
  SurfaceReport Report() const override { return relief_.report; }

 private:
  DemSurface(const HeightGrid& dem, const TerrainOptions& options, uint64_t seed, double resolution)
      : dem_(dem),
        box_(SearchBox(dem_)),
        craters_(Below(options.craters, resolution), StreamSeed(seed, "dem craters"), box_,
                 kSurroundings),
        ripples_(Below(options.ripples, resolution), StreamSeed(seed, "ripples")),
        clods_(options.clods, StreamSeed(seed, "clods")),
        relief_(ContinueRelief(
            dem_, resolution,
            [this](double x, double y) {
              return craters_.Height(x, y, kCraterPosts * kFitSpacing) +
                     ripples_.Height(x, y, kFitSpacing);
            },
            options.relief, box_, StreamSeed(seed, "relief"))),
        albedo_(options.albedo, StreamSeed(seed, "albedo")),
        rocks_(options.rocks, StreamSeed(seed, "rocks"), craters_, box_),
        rock_shapes_(MakeRockShapes(options.rocks.height_share)) {}

  Dem dem_;
  Eigen::AlignedBox2d box_;
  CraterField craters_;
  RippleField ripples_;
  ClodField clods_;
  DemRelief relief_;
  AlbedoField albedo_;
  RockField rocks_;
  std::vector<RockShape> rock_shapes_;
};

}  // namespace

void Surface::Sample(const PostBlock& block, std::vector<double>* heights,
                     std::vector<float>* albedo) const {
  heights->clear();
  albedo->clear();
  for (int j = 0; j < block.rows; ++j) {
    for (int i = 0; i < block.columns; ++i) {
      const double x = block.x + i * block.spacing;
      const double y = block.y + j * block.spacing;
      heights->push_back(Height(x, y, block.spacing));
      albedo->push_back(static_cast<float>(Albedo(x, y, block.spacing)));
    }
  }
}

std::vector<Rock> Surface::Rocks(const Eigen::AlignedBox2d&, double) const { return {}; }

std::vector<RockShape> Surface::RockShapes() const { return {}; }

SurfaceReport Surface::Report() const { return {}; }

std::unique_ptr<Surface> CreateGeneratedSurface(const TerrainOptions& options, uint64_t seed,
                                                const Eigen::AlignedBox2d& box) {
  options.Check();
  return std::make_unique<GeneratedSurface>(options, seed, box);
}

std::unique_ptr<Surface> CreateDemSurface(const HeightGrid& dem, const TerrainOptions& options,
                                          uint64_t seed) {
  options.Check();
  return std::make_unique<DemSurface>(dem, options, seed);
}

namespace {

// The blocks in which a grid is sampled, posts a side.
constexpr int kTile = 128;

void SampleTiles(const Surface& surface, const PostBlock& whole, double ground, HeightGrid* grid) {
  std::vector<double> heights;
  std::vector<float> albedo;
  for (int row = 0; row < whole.rows; row += kTile) {
    for (int column = 0; column < whole.columns; column += kTile) {
      const PostBlock tile{whole.x + column * whole.spacing, whole.y + row * whole.spacing,
                           whole.spacing, std::min(kTile, whole.columns - column),
                           std::min(kTile, whole.rows - row)};
      surface.Sample(tile, &heights, &albedo);
      const double* height = heights.data();
      for (int j = 0; j < tile.rows; ++j) {
        for (int i = 0; i < tile.columns; ++i) {
          grid->At(column + i, whole.rows - 1 - row - j) = static_cast<float>(*height++ - ground);
        }
      }
    }
  }
}

void RaiseRock(const Rock& rock, const RockTops& tops, const PostBlock& whole, double ground,
               HeightGrid* grid) {
  const double reach = tops.reach() * rock.diameter;
  const auto first = [&](double from) {
    return std::max(0, static_cast<int>(std::ceil((from - reach) / whole.spacing)));
  };
  const auto last = [&](double from, int count) {
    return std::min(count - 1, static_cast<int>(std::floor((from + reach) / whole.spacing)));
  };
  const Eigen::Vector2d from = rock.centre - Eigen::Vector2d(whole.x, whole.y);
  for (int j = first(from.y()); j <= last(from.y(), whole.rows); ++j) {
    for (int i = first(from.x()); i <= last(from.x(), whole.columns); ++i) {
      float& height = grid->At(i, whole.rows - 1 - j);
      const double top =
          tops.Top(rock, whole.x + i * whole.spacing, whole.y + j * whole.spacing) - ground;
      height = std::max(height, static_cast<float>(top));
    }
  }
}

}  // namespace

HeightGrid SampleSurface(const Surface& surface, const Eigen::AlignedBox2d& box, double spacing,
                         const Eigen::Vector3d& origin) {
  HeightGrid grid;
  grid.columns = static_cast<int>(std::ceil(box.sizes().x() / spacing)) + 1;
  grid.rows = static_cast<int>(std::ceil(box.sizes().y() / spacing)) + 1;
  grid.spacing = spacing;
  grid.origin = Eigen::Vector2d(box.min().x(), box.max().y()) - origin.head<2>();
  grid.heights.resize(static_cast<size_t>(grid.columns) * static_cast<size_t>(grid.rows));
  const PostBlock whole{box.min().x(), box.max().y() - (grid.rows - 1) * spacing, spacing,
                        grid.columns, grid.rows};
  SampleTiles(surface, whole, origin.z(), &grid);
  const RockTops tops(surface.RockShapes());
  constexpr double kWidestRock = 20.0;  // m, as RockOptions allows
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(tops.reach() * kWidestRock);
  for (const Rock& rock : surface.Rocks({box.min() - margin, box.max() + margin}, 0.05)) {
    RaiseRock(rock, tops, whole, origin.z(), &grid);
  }
  return grid;
}

}  // namespace regolith
