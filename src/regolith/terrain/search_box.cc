// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/search_box.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

constexpr double kHalfSide = 400.0;       // m
constexpr int kSquares = 17;              // looked at along each side of the model
constexpr int kPlaces = 24;               // along each side of a square
constexpr double kSteep = 0.12;           // tangent: of 7 degrees, leaving room for finer relief
constexpr double kPriceOfDistance = 0.1;  // share of steep places that the way to the border equals

// Share of a square's places that a rover had better avoid.
double ShareOfBadGround(const Dem& dem, const Eigen::AlignedBox2d& square) {
  int bad = 0;
  for (int j = 0; j < kPlaces; ++j) {
    for (int i = 0; i < kPlaces; ++i) {
      const Eigen::Vector2d place =
          square.min() + Eigen::Vector2d((i + 0.5) * square.sizes().x() / kPlaces,
                                         (j + 0.5) * square.sizes().y() / kPlaces);
      const double step = dem.spacing();
      const double east =
          dem.Height(place.x() + step, place.y()) - dem.Height(place.x() - step, place.y());
      const double north =
          dem.Height(place.x(), place.y() + step) - dem.Height(place.x(), place.y() - step);
      const bool steep = std::hypot(east, north) > 2.0 * step * kSteep;
      if (steep || !dem.HasData(place.x(), place.y(), step)) ++bad;
    }
  }
  return static_cast<double>(bad) / (kPlaces * kPlaces);
}

}  // namespace

Eigen::AlignedBox2d SearchBox(const Dem& dem) {
  const Eigen::Vector2d half = dem.half_size().cwiseMin(Eigen::Vector2d::Constant(kHalfSide));
  const Eigen::Vector2d room = dem.half_size() - half;
  const Eigen::AlignedBox2d central(-half, half);
  if (room.maxCoeff() <= 0.0) return central;
  Eigen::AlignedBox2d best = central;
  double least = ShareOfBadGround(dem, central);
  for (int j = 0; j < kSquares; ++j) {
    for (int i = 0; i < kSquares; ++i) {
      const Eigen::Vector2d share(2.0 * i / (kSquares - 1) - 1.0, 2.0 * j / (kSquares - 1) - 1.0);
      const Eigen::Vector2d centre = share.cwiseProduct(room);
      const Eigen::AlignedBox2d square(centre - half, centre + half);
      const double cost = ShareOfBadGround(dem, square) + kPriceOfDistance * share.norm();
      if (cost >= least) continue;
      least = cost;
      best = square;
    }
  }
  return best;
}

}  // namespace regolith
