// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/tile_tree.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"

namespace regolith {
namespace {

struct Ring {
  double spacing;  // m
  double reach;    // m from the path
};
constexpr Ring kRings[] = {{0.005, 5.0}, {0.01, 8.0}, {0.02, 12.0}, {0.04, 24.0}};
// A pixel of the cameras is 1 / 380 of its distance wide.
constexpr double kReachBySpacing = 500.0;
constexpr double kRoverReachBySpacing = 800.0;
// The finest posts cost the most and are seen best just before the rover.
constexpr double kFinest = 0.005;     // m
constexpr double kFinestReach = 3.0;  // m

// Path points that can decide about a square: those within the coarsest reach of its border.
std::vector<Eigen::Vector2d> Near(const Eigen::AlignedBox2d& box, double reach,
                                  Span<const Eigen::Vector2d> path) {
  std::vector<Eigen::Vector2d> near;
  for (const Eigen::Vector2d& place : path) {
    if (box.squaredExteriorDistance(place) < reach * reach) near.push_back(place);
  }
  return near;
}

}  // namespace

double PathReach(double spacing) {
  for (const Ring& ring : kRings) {
    if (spacing <= 1.001 * ring.spacing) return ring.reach;
  }
  return kReachBySpacing * spacing;
}

double RoverReach(double spacing) {
  return spacing <= 1.001 * kFinest ? kFinestReach : kRoverReachBySpacing * spacing;
}

TileTree::TileTree(const MeshOptions& options, Span<const Eigen::Vector2d> path)
    : finest_(options.spacing), path_(path.begin(), path.end()) {
  REGOLITH_CHECK(!path_.empty(), "ground needs a path");
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& place : path_) box.extend(place);
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(options.reach);
  box = {box.min() - reach, box.max() + reach};
  // The coarsest level that any place within reach is left at.
  top_level_ = 0;
  while (PathReach(Spacing(top_level_)) < options.reach) ++top_level_;
  const double size = Size(top_level_);
  const Eigen::Array2d low = (box.min().array() / size).floor();
  const Eigen::Array2d high = (box.max().array() / size).ceil();
  for (int row = static_cast<int>(low.y()); row < static_cast<int>(high.y()); ++row) {
    for (int column = static_cast<int>(low.x()); column < static_cast<int>(high.x()); ++column) {
      roots_.push_back({top_level_, column, row});
    }
  }
}

double TileTree::Spacing(int level) const { return std::ldexp(finest_, level); }

Eigen::Vector2d TileTree::Corner(const TileKey& key) const {
  return Size(key.level) * Eigen::Vector2d(key.column, key.row);
}

Eigen::AlignedBox2d TileTree::Box(const TileKey& key) const {
  const Eigen::Vector2d corner = Corner(key);
  return {corner, corner + Eigen::Vector2d::Constant(Size(key.level))};
}

std::vector<TileKey> TileTree::Wanted(const Eigen::Vector2d& position) const {
  std::vector<TileKey> tiles;
  for (const TileKey& root : roots_) Divide(root, position, path_, &tiles);
  std::sort(tiles.begin(), tiles.end());
  return tiles;
}

void TileTree::Divide(const TileKey& key, const Eigen::Vector2d& position,
                      Span<const Eigen::Vector2d> path, std::vector<TileKey>* tiles) const {
  const Eigen::AlignedBox2d box = Box(key);
  const double finer = Spacing(key.level - 1);
  std::vector<Eigen::Vector2d> near;
  if (key.level > 0 && box.exteriorDistance(position) < RoverReach(finer)) {
    near = Near(box, PathReach(finer), path);
  }
  if (near.empty()) {
    tiles->push_back(key);
    return;
  }
  for (int i = 0; i < 4; ++i) {
    Divide({key.level - 1, 2 * key.column + i % 2, 2 * key.row + i / 2}, position, near, tiles);
  }
}

}  // namespace regolith
