// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/clods.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr double kSmallest = 0.01;  // m
constexpr double kLargest = 0.05;   // m: rocks begin
constexpr double kPostsAcross = 2.0;
constexpr double kCellDiameters = 2.0;

}  // namespace

ClodField::ClodField(const ClodOptions& options, uint64_t seed) : exponent_(options.exponent) {
  if (options.density <= 0.0) return;
  const auto wider = [&](double diameter) {
    return options.density * std::pow(diameter / kSmallest, -options.exponent);
  };
  Random random(seed);
  const double middle = std::sqrt(kSmallest * kLargest);
  for (const auto& [low, high] : {std::pair(kSmallest, middle), std::pair(middle, kLargest)}) {
    const double turn = random.Uniform(0.0, 2.0 * M_PI);
    const double cell = kCellDiameters * high;
    classes_.push_back({random.Next(), low, high, cell,
                        std::min(1.0, (wider(low) - wider(high)) * cell * cell), std::cos(turn),
                        std::sin(turn)});
  }
}

std::optional<ClodField::Clod> ClodField::Draw(const Class& sizes, int64_t column,
                                               int64_t row) const {
  Random random(Scramble(sizes.seed ^ static_cast<uint64_t>(column)) ^ static_cast<uint64_t>(row));
  if (random.Uniform() >= sizes.share) return {};
  // Inverse of the power law between the class's bounds.
  const double rank = random.Uniform() * (1.0 - std::pow(sizes.high / sizes.low, -exponent_));
  const double diameter = sizes.low * std::pow(1.0 - rank, -1.0 / exponent_);
  const double aspect = random.Uniform(1.0, 1.5);
  const double longer = 0.5 * diameter * std::sqrt(aspect);
  const double shorter = 0.5 * diameter / std::sqrt(aspect);
  const double u =
      random.Uniform(longer, sizes.cell - longer) + static_cast<double>(column) * sizes.cell;
  const double v =
      random.Uniform(longer, sizes.cell - longer) + static_cast<double>(row) * sizes.cell;
  const double turn = random.Uniform(0.0, 2.0 * M_PI);
  const Eigen::Vector2d axis(std::cos(turn), std::sin(turn));
  Clod clod;
  clod.centre = {sizes.cosine * u + sizes.sine * v, sizes.cosine * v - sizes.sine * u};
  clod.along = axis / longer;
  clod.across = Eigen::Vector2d(-axis.y(), axis.x()) / shorter;
  clod.height = diameter * random.Uniform(0.3, 0.6);
  const double tilt = random.Uniform(0.1, 0.6);
  const double way = random.Uniform(0.0, 2.0 * M_PI);
  clod.facet = tilt / longer * Eigen::Vector2d(std::cos(way), std::sin(way));
  clod.reach = longer;
  return clod;
}

// A steep-sided bump whose top is cut by a tilted plane.
double ClodField::HeightOf(const Clod& clod, const Eigen::Vector2d& place) {
  const Eigen::Vector2d offset = place - clod.centre;
  const double square = std::pow(clod.along.dot(offset), 2) + std::pow(clod.across.dot(offset), 2);
  if (square >= 1.0) return 0.0;
  return clod.height * std::min(1.0 - square * square, 0.75 + clod.facet.dot(offset));
}

double ClodField::Height(double x, double y, double spacing) const {
  double height = 0.0;
  for (const Class& sizes : classes_) {
    if (sizes.low < kPostsAcross * spacing) continue;
    const double u = sizes.cosine * x - sizes.sine * y;
    const double v = sizes.sine * x + sizes.cosine * y;
    const auto clod = Draw(sizes, static_cast<int64_t>(std::floor(u / sizes.cell)),
                           static_cast<int64_t>(std::floor(v / sizes.cell)));
    if (clod) height += HeightOf(*clod, {x, y});
  }
  return height;
}

void ClodField::AddTo(const PostBlock& block, double* heights) const {
  const Eigen::Vector2d corner(block.x, block.y);
  const Eigen::Vector2d half =
      0.5 * block.spacing * Eigen::Vector2d(block.columns - 1, block.rows - 1);
  const Eigen::Vector2d centre = corner + half;
  for (const Class& sizes : classes_) {
    if (sizes.low < kPostsAcross * block.spacing) continue;
    const auto cell = [&](double value) {
      return static_cast<int64_t>(std::floor(value / sizes.cell));
    };
    const double u = sizes.cosine * centre.x() - sizes.sine * centre.y();
    const double v = sizes.sine * centre.x() + sizes.cosine * centre.y();
    const double reach = half.norm();
    for (int64_t row = cell(v - reach); row <= cell(v + reach); ++row) {
      for (int64_t column = cell(u - reach); column <= cell(u + reach); ++column) {
        const auto clod = Draw(sizes, column, row);
        if (!clod) continue;
        const Eigen::Vector2d low =
            (clod->centre - corner - Eigen::Vector2d::Constant(clod->reach)) / block.spacing;
        const Eigen::Vector2d high =
            (clod->centre - corner + Eigen::Vector2d::Constant(clod->reach)) / block.spacing;
        const int last_row = static_cast<int>(std::min(high.y(), block.rows - 1.0));
        const int last_column = static_cast<int>(std::min(high.x(), block.columns - 1.0));
        if (high.x() < 0.0 || high.y() < 0.0) continue;
        for (int j = std::max(0, static_cast<int>(std::ceil(low.y()))); j <= last_row; ++j) {
          for (int i = std::max(0, static_cast<int>(std::ceil(low.x()))); i <= last_column; ++i) {
            heights[static_cast<ptrdiff_t>(j) * block.columns + i] +=
                HeightOf(*clod, corner + block.spacing * Eigen::Vector2d(i, j));
          }
        }
      }
    }
  }
}

}  // namespace regolith
