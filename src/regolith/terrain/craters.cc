// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/craters.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

// The rim of a fresh crater is about a fifth of its depth (Pike 1977: .036 to .196 of D); rims
// vanish faster than bowls, as the square of what is left.
constexpr double kRimShareOfDepth = 0.18;
constexpr double kRimWidthInside = 0.3;      // radii
constexpr double kRimWidthOutside = 0.4;     // radii
constexpr double kVisibleDiameters = 100.0;  // distance from which a crater shows

double Square(double value) { return value * value; }

// Craters of one cell of the plane, drawn from the cell's own seed. Diameters follow N(> D) ~ D^-2
// within [low, high).
void DrawCell(const CraterOptions& options, uint64_t cell_seed, const Eigen::Vector2d& corner,
              double cell_size, double low, double high, std::vector<Crater>* craters) {
  Random random(cell_seed);
  const double density = options.density * (1.0 / Square(low) - 1.0 / Square(high));
  const int64_t count = random.Poisson(density * Square(cell_size));
  for (int64_t i = 0; i < count; ++i) {
    Crater crater;
    crater.centre = corner + cell_size * Eigen::Vector2d(random.Uniform(), random.Uniform());
    const double left = 1.0 - random.Uniform() * (1.0 - Square(low / high));
    crater.diameter = low / std::sqrt(left);
    // Most craters of a surface in equilibrium are old (Mahanti et al. 2018).
    const double freshness = Square(random.Uniform());
    crater.depth = options.oldest_depth + freshness * (options.fresh_depth - options.oldest_depth);
    crater.rim = kRimShareOfDepth * crater.depth * freshness;
    craters->push_back(crater);
  }
}

std::vector<Crater> DrawClass(const CraterOptions& options, uint64_t seed, double low, double high,
                              const Eigen::AlignedBox2d& box) {
  const double cell_size = 8.0 * high;
  const double margin = 0.5 * kCraterReach * high;
  const auto first_column = static_cast<int64_t>(std::floor((box.min().x() - margin) / cell_size));
  const auto first_row = static_cast<int64_t>(std::floor((box.min().y() - margin) / cell_size));
  const auto last_column = static_cast<int64_t>(std::floor((box.max().x() + margin) / cell_size));
  const auto last_row = static_cast<int64_t>(std::floor((box.max().y() + margin) / cell_size));
  std::vector<Crater> craters;
  for (int64_t row = first_row; row <= last_row; ++row) {
    for (int64_t column = first_column; column <= last_column; ++column) {
      const uint64_t cell_seed =
          Scramble(Scramble(seed ^ static_cast<uint64_t>(column)) ^ static_cast<uint64_t>(row));
      const Eigen::Vector2d corner(static_cast<double>(column) * cell_size,
                                   static_cast<double>(row) * cell_size);
      DrawCell(options, cell_seed, corner, cell_size, low, high, &craters);
    }
  }
  return craters;
}

}  // namespace

double CraterHeight(const Crater& crater, double distance) {
  const double x = 2.0 * distance / crater.diameter;
  if (x >= kCraterReach) return 0.0;
  const double width = x < 1.0 ? kRimWidthInside : kRimWidthOutside;
  // The last factor takes the Gaussian to zero, slope included, where the crater ends.
  double height = crater.rim * std::exp(-Square((x - 1.0) / width)) *
                  Square(1.0 - Square(x / kCraterReach)) / Square(1.0 - Square(1.0 / kCraterReach));
  if (x < 1.0) height -= (crater.depth - crater.rim) * Square(1.0 - Square(x));
  return crater.diameter * height;
}

CraterField::CraterField(const CraterOptions& options, uint64_t seed,
                         const Eigen::AlignedBox2d& box, double surroundings) {
  if (options.density <= 0.0) return;
  uint64_t index = 0;
  for (double low = options.min_diameter; low < options.max_diameter; low *= 2.0) {
    const double high = std::min(2.0 * low, options.max_diameter);
    const Eigen::Vector2d margin =
        Eigen::Vector2d::Constant(std::min(surroundings, kVisibleDiameters * high));
    const Eigen::AlignedBox2d around(box.min() - margin, box.max() + margin);
    const std::vector<Crater> craters =
        DrawClass(options, Scramble(seed + index++), low, high, around);
    size_ += craters.size();
    classes_.push_back(MakeClass(craters, high, around));
  }
}

CraterField::Class CraterField::MakeClass(const std::vector<Crater>& craters, double max_diameter,
                                          const Eigen::AlignedBox2d& box) {
  Class result;
  result.max_diameter = max_diameter;
  result.bin_size = kCraterReach * max_diameter;
  result.corner = box.min();
  const Eigen::Vector2d size = box.sizes() / result.bin_size;
  result.columns = static_cast<int>(size.x()) + 1;
  result.rows = static_cast<int>(size.y()) + 1;
  const auto bin_count = static_cast<size_t>(result.columns) * static_cast<size_t>(result.rows);
  std::vector<std::vector<Crater>> bins(bin_count);
  for (const Crater& crater : craters) {
    const double reach = 0.5 * kCraterReach * crater.diameter;
    const Eigen::Vector2d offset = crater.centre - result.corner;
    const auto bin = [&](double value) {
      return static_cast<int>(std::floor(value / result.bin_size));
    };
    const int last_row = std::min(bin(offset.y() + reach), result.rows - 1);
    const int last_column = std::min(bin(offset.x() + reach), result.columns - 1);
    for (int row = std::max(bin(offset.y() - reach), 0); row <= last_row; ++row) {
      for (int column = std::max(bin(offset.x() - reach), 0); column <= last_column; ++column) {
        bins[static_cast<size_t>(row) * static_cast<size_t>(result.columns) +
             static_cast<size_t>(column)]
            .push_back(crater);
      }
    }
  }
  result.starts.push_back(0);
  for (const std::vector<Crater>& bin : bins) {
    result.craters.insert(result.craters.end(), bin.begin(), bin.end());
    result.starts.push_back(static_cast<uint32_t>(result.craters.size()));
  }
  return result;
}

double CraterField::Height(double x, double y, double min_diameter) const {
  double height = 0.0;
  for (const Class& craters : classes_) {
    if (craters.max_diameter < min_diameter) continue;
    const auto column = static_cast<int>(std::floor((x - craters.corner.x()) / craters.bin_size));
    const auto row = static_cast<int>(std::floor((y - craters.corner.y()) / craters.bin_size));
    if (column < 0 || row < 0 || column >= craters.columns || row >= craters.rows) continue;
    const size_t bin = static_cast<size_t>(row) * static_cast<size_t>(craters.columns) +
                       static_cast<size_t>(column);
    for (uint32_t i = craters.starts[bin]; i < craters.starts[bin + 1]; ++i) {
      const Crater& crater = craters.craters[i];
      if (crater.diameter < min_diameter) continue;
      const double reach = 0.5 * kCraterReach * crater.diameter;
      const double distance_squared = Square(x - crater.centre.x()) + Square(y - crater.centre.y());
      if (distance_squared >= reach * reach) continue;
      height += CraterHeight(crater, std::sqrt(distance_squared));
    }
  }
  return height;
}

}  // namespace regolith
