// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/drive_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/suspension.h"

namespace regolith {
namespace {

constexpr double kCell = 0.25;  // m
constexpr int kCells = 64;      // along a tile
constexpr int kMargin = 2;      // cells around it: half of the metre that slopes are taken over
constexpr double kTile = kCell * kCells;
constexpr int kBins = 16;              // of 1 m along a tile
constexpr double kKnownMargin = 3.0;   // m of real ground on all sides
constexpr double kBodyRadius = 0.65;   // m, of the rover seen from above, wheels included
constexpr double kTrackMargin = 0.03;  // m: front wheels leave the base's track in curves
constexpr double kJointMargin = 0.06;  // m: outside a curve, pieces of track leave a wedge open
constexpr double kLargestRock = 8.0;   // m
constexpr auto kClosed = std::numeric_limits<float>::infinity();

// Rocks are about half as high as wide (Golombek et al. 2003).
bool TouchesBelly(double diameter) { return 0.5 * diameter > kBellyClearance; }

}  // namespace

bool OnWheelTrack(double aside, double diameter) {
  return std::abs(std::abs(aside) - kHalfTrack) < kHalfWheelWidth + 0.5 * diameter;
}

DriveMap::DriveMap(const Surface& surface, double max_slope)
    : surface_(surface), max_rise_(std::tan(max_slope)) {}

void DriveMap::FillSteepness(const Eigen::Vector2d& corner, Tile* tile) const {
  const int posts = kCells + 2 * kMargin;
  PostBlock block;
  block.x = corner.x() + (0.5 - kMargin) * kCell;
  block.y = corner.y() + (0.5 - kMargin) * kCell;
  block.spacing = kCell;
  block.columns = posts;
  block.rows = posts;
  std::vector<double> heights;
  std::vector<float> albedo;
  surface_.Sample(block, &heights, &albedo);
  tile->steepness.assign(static_cast<size_t>(kCells) * kCells, kClosed);
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const double x = corner.x() + (i + 0.5) * kCell;
      const double y = corner.y() + (j + 0.5) * kCell;
      if (!surface_.Known(x, y, kKnownMargin)) continue;
      const auto post = [&](int di, int dj) {
        return heights[static_cast<size_t>(j + kMargin + dj) * static_cast<size_t>(posts) +
                       static_cast<size_t>(i + kMargin + di)];
      };
      const double rise =
          std::hypot(post(kMargin, 0) - post(-kMargin, 0), post(0, kMargin) - post(0, -kMargin)) /
          (2 * kMargin * kCell);
      tile->steepness[static_cast<size_t>(j) * kCells + static_cast<size_t>(i)] =
          static_cast<float>(rise / max_rise_);
    }
  }
}

DriveMap::Tile DriveMap::MakeTile(const Eigen::Vector2d& corner) const {
  Tile tile;
  FillSteepness(corner, &tile);
  tile.bins.resize(static_cast<size_t>(kBins) * kBins);
  const Eigen::Vector2d far = Eigen::Vector2d::Constant(0.5 * kLargestRock + 1.0);
  const Eigen::Vector2d high = corner + Eigen::Vector2d::Constant(kTile);
  for (const Rock& rock : surface_.Rocks({corner - far, high + far}, kObstacle)) {
    const double reach = 0.5 * rock.diameter + 0.9;
    const Eigen::Vector2d place = rock.centre - corner;
    const auto bin = [](double x) {
      return std::clamp(static_cast<int>(std::floor(x)), -1, kBins);
    };
    for (int j = std::max(bin(place.y() - reach), 0);
         j <= std::min(bin(place.y() + reach), kBins - 1); ++j) {
      for (int i = std::max(bin(place.x() - reach), 0);
           i <= std::min(bin(place.x() + reach), kBins - 1); ++i) {
        tile.bins[static_cast<size_t>(j) * kBins + static_cast<size_t>(i)].push_back(rock);
      }
    }
  }
  return tile;
}

DriveMap::Tile& DriveMap::TileAt(const Eigen::Vector2d& place, Eigen::Vector2d* inside) {
  const double column = std::floor(place.x() / kTile);
  const double row = std::floor(place.y() / kTile);
  const Eigen::Vector2d corner(column * kTile, row * kTile);
  *inside = place - corner;
  const int64_t key =
      (static_cast<int64_t>(column) + 1000000) * 4000000 + static_cast<int64_t>(row) + 1000000;
  if (key == last_key_) return *last_;
  auto entry = tiles_.find(key);
  if (entry == tiles_.end()) entry = tiles_.emplace(key, MakeTile(corner)).first;
  last_key_ = key;
  last_ = &entry->second;
  return *last_;
}

double DriveMap::Steepness(const Eigen::Vector2d& place) {
  Eigen::Vector2d inside;
  const Tile& tile = TileAt(place, &inside);
  const int i = std::clamp(static_cast<int>(inside.x() / kCell), 0, kCells - 1);
  const int j = std::clamp(static_cast<int>(inside.y() / kCell), 0, kCells - 1);
  return static_cast<double>(
      tile.steepness[static_cast<size_t>(j) * kCells + static_cast<size_t>(i)]);
}

void DriveMap::Block(const Eigen::Vector2d& place, double radius) {
  const int reach = static_cast<int>(std::ceil(radius / kCell));
  for (int dj = -reach; dj <= reach; ++dj) {
    for (int di = -reach; di <= reach; ++di) {
      if (std::hypot(di, dj) * kCell > radius) continue;
      Eigen::Vector2d inside;
      Tile& tile = TileAt(place + kCell * Eigen::Vector2d(di, dj), &inside);
      const int i = std::clamp(static_cast<int>(inside.x() / kCell), 0, kCells - 1);
      const int j = std::clamp(static_cast<int>(inside.y() / kCell), 0, kCells - 1);
      tile.steepness[static_cast<size_t>(j) * kCells + static_cast<size_t>(i)] = kClosed;
    }
  }
}

const std::vector<Rock>& DriveMap::RocksNear(const Eigen::Vector2d& place) {
  Eigen::Vector2d inside;
  const Tile& tile = TileAt(place, &inside);
  const int i = std::clamp(static_cast<int>(inside.x()), 0, kBins - 1);
  const int j = std::clamp(static_cast<int>(inside.y()), 0, kBins - 1);
  return tile.bins[static_cast<size_t>(j) * kBins + static_cast<size_t>(i)];
}

int DriveMap::TrackHits(const Eigen::Vector2d& middle, double yaw, double length) {
  const Eigen::Vector2d ahead(std::cos(yaw), std::sin(yaw));
  int hits = 0;
  for (const Rock& rock : RocksNear(middle)) {
    const Eigen::Vector2d offset = rock.centre - middle;
    if (TouchesBelly(rock.diameter)) {
      if (offset.norm() < kBodyRadius + 0.5 * rock.diameter) return -1;
      continue;
    }
    if (std::abs(offset.dot(ahead)) > 0.5 * length + kJointMargin) continue;
    const double aside = ahead.x() * offset.y() - ahead.y() * offset.x();
    if (OnWheelTrack(aside, rock.diameter + 2.0 * kTrackMargin)) ++hits;
  }
  return hits;
}

int DriveMap::TurnHits(const Eigen::Vector2d& place) {
  const double wheels = std::hypot(kHalfWheelbase, kHalfTrack);
  int hits = 0;
  for (const Rock& rock : RocksNear(place)) {
    const double distance = (rock.centre - place).norm();
    if (TouchesBelly(rock.diameter) && distance < kBodyRadius + 0.5 * rock.diameter) return -1;
    if (std::abs(distance - wheels) < 0.14 + 0.5 * rock.diameter) ++hits;
  }
  return hits;
}

}  // namespace regolith
