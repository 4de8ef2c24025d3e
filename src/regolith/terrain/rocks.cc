// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/rocks.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"
#include "regolith/terrain/rock_shapes.h"

namespace regolith {
namespace {

constexpr double kEjectaCraters = 2.0;  // m: smaller craters dig no rocks out of the regolith
constexpr double kMostEjecta = 6.0;     // of the mean
constexpr int kMeanSamples = 20000;

// ∫_x^∞ e^(-t) / t dt: series and continued fraction (Abramowitz and Stegun 5.1.11, 5.1.22).
double ExponentialIntegral(double x) {
  if (x < 1.5) {
    constexpr double kEuler = 0.5772156649015329;
    double sum = -kEuler - std::log(x);
    double term = 1.0;
    for (int k = 1; k < 30; ++k) {
      term *= -x / k;
      sum -= term / k;
    }
    return sum;
  }
  double fraction = 0.0;
  for (int k = 60; k > 0; --k) fraction = k / (1.0 + k / (x + fraction));
  return std::exp(-x) / (x + fraction);
}

// Golombek and Rapp 1997: F(> D) = k e^(-q D) of the area; divided by the area of a rock and
// integrated by parts it gives the number.
double GolombekDensity(double k, double diameter) {
  const double q = 1.79 + 0.152 / k;
  return 4.0 * k * q / M_PI *
         (std::exp(-q * diameter) / diameter - q * ExponentialIntegral(q * diameter));
}

}  // namespace

double RockDensity(const RockOptions& options, double diameter) {
  switch (options.law) {
    case RockLaw::kPower:
      return options.density * std::pow(diameter / 0.25, -options.exponent);
    case RockLaw::kGolombek:
      return GolombekDensity(options.cover, diameter);
    case RockLaw::kNone:
      break;
  }
  return 0.0;
}

RockField::RockField(const RockOptions& options, uint64_t seed, const CraterField& craters,
                     const Eigen::AlignedBox2d& box)
    : options_(options), seed_(seed), craters_(&craters) {
  if (options.law == RockLaw::kNone || options.clustering == 0.0) return;
  std::vector<double> ejecta;
  Random random(seed, "ejecta");
  for (int i = 0; i < kMeanSamples; ++i) {
    const double x = random.Uniform(box.min().x(), box.max().x());
    ejecta.push_back(
        craters.Ejecta(x, random.Uniform(box.min().y(), box.max().y()), kEjectaCraters));
  }
  // Peaks are cut at a multiple of the mean, which lowers the mean: a few rounds settle it.
  for (int round = 0; round < 20; ++round) {
    double sum = 0.0;
    for (const double value : ejecta) {
      sum += round == 0 ? value : std::min(value, kMostEjecta * mean_ejecta_);
    }
    mean_ejecta_ = sum / kMeanSamples;
  }
}

double RockField::Intensity(double x, double y) const {
  if (mean_ejecta_ <= 0.0) return 1.0;
  const double ejecta = craters_->Ejecta(x, y, kEjectaCraters) / mean_ejecta_;
  return 1.0 - options_.clustering + options_.clustering * std::min(ejecta, kMostEjecta);
}

void RockField::DrawCell(uint64_t cell_seed, const Eigen::AlignedBox2d& cell, double low,
                         double high, std::vector<Rock>* rocks) const {
  Random random(cell_seed);
  const double wider = RockDensity(options_, high);
  const double density = RockDensity(options_, low) - wider;
  const double most = 1.0 + options_.clustering * (kMostEjecta - 1.0);
  const int64_t count = random.Poisson(most * density * cell.volume());
  for (int64_t i = 0; i < count; ++i) {
    // As many draws for one that is left out as for one that stays.
    Random own(random.Next());
    Rock rock;
    rock.centre = {own.Uniform(cell.min().x(), cell.max().x()),
                   own.Uniform(cell.min().y(), cell.max().y())};
    if (own.Uniform() * most >= Intensity(rock.centre.x(), rock.centre.y())) continue;
    const double rank = wider + own.Uniform() * density;
    double lower = low;
    double upper = high;
    for (int k = 0; k < 20; ++k) {
      const double middle = 0.5 * (lower + upper);
      (RockDensity(options_, middle) > rank ? lower : upper) = middle;
    }
    rock.diameter = lower;
    rock.yaw = own.Uniform(0.0, 2.0 * M_PI);
    rock.shape = static_cast<uint32_t>(own.Uniform(0.0, kRockShapes));
    rock.brightness = static_cast<float>(std::exp(own.Gaussian(0.15, 0.2)));
    rocks->push_back(rock);
  }
}

std::vector<Rock> RockField::Rocks(const Eigen::AlignedBox2d& box, double min_diameter) const {
  std::vector<Rock> rocks;
  if (options_.law == RockLaw::kNone) return rocks;
  uint64_t index = 0;
  for (double low = options_.min_diameter; low < options_.max_diameter; low *= 2.0, ++index) {
    const double high = std::min(2.0 * low, options_.max_diameter);
    if (high <= min_diameter) continue;
    const double size = 16.0 * low;
    const auto cell = [&](double value) { return static_cast<int64_t>(std::floor(value / size)); };
    for (int64_t row = cell(box.min().y()); row <= cell(box.max().y()); ++row) {
      for (int64_t column = cell(box.min().x()); column <= cell(box.max().x()); ++column) {
        const Eigen::Vector2d corner(static_cast<double>(column) * size,
                                     static_cast<double>(row) * size);
        const uint64_t seed = Scramble(Scramble(seed_ + index) ^ static_cast<uint64_t>(column));
        DrawCell(Scramble(seed ^ static_cast<uint64_t>(row)),
                 {corner, corner + Eigen::Vector2d::Constant(size)}, low, high, &rocks);
      }
    }
  }
  rocks.erase(std::remove_if(rocks.begin(), rocks.end(),
                             [&](const Rock& rock) {
                               return rock.diameter < min_diameter || !box.contains(rock.centre);
                             }),
              rocks.end());
  return rocks;
}

}  // namespace regolith
