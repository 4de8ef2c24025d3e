// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/exports/shaded_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kShadowLevel = 14.0;
constexpr double kDarkest = 30.0;
constexpr double kBrightest = 250.0;

// Every n-th post, so that the longer side has at most `largest` pixels.
HeightGrid Thinned(const HeightGrid& grid, int largest) {
  const int step = std::max(1, (std::max(grid.columns, grid.rows) + largest - 1) / largest);
  HeightGrid thin;
  thin.columns = (grid.columns + step - 1) / step;
  thin.rows = (grid.rows + step - 1) / step;
  thin.spacing = grid.spacing * step;
  for (int row = 0; row < thin.rows; ++row) {
    for (int column = 0; column < thin.columns; ++column) {
      thin.heights.push_back(grid.At(column * step, row * step));
    }
  }
  return thin;
}

// The height below which each post lies in shadow. Lines of posts are visited away from the sun;
// each asks the line before it, at the place where the ray to the sun crosses that.
std::vector<double> ShadowHeights(const HeightGrid& grid, const Eigen::Vector2d& to_sun,
                                  double tangent) {
  const double lowest = -std::numeric_limits<double>::max();
  std::vector<double> shadow(grid.heights.size(), lowest);
  const bool along_columns = std::abs(to_sun.x()) >= std::abs(to_sun.y());
  const double major = along_columns ? to_sun.x() : to_sun.y();
  const double slant = (along_columns ? to_sun.y() : to_sun.x()) / std::abs(major);
  const double drop = grid.spacing * std::hypot(1.0, slant) * tangent;
  const int lines = along_columns ? grid.columns : grid.rows;
  const int length = along_columns ? grid.rows : grid.columns;
  const auto index = [&](int line, int place) {
    const int column = along_columns ? line : place;
    const int row = along_columns ? place : line;
    return static_cast<size_t>(row) * static_cast<size_t>(grid.columns) +
           static_cast<size_t>(column);
  };
  const auto top = [&](int line, int place) {
    const size_t i = index(line, place);
    return std::isfinite(grid.heights[i]) ? std::max<double>(grid.heights[i], shadow[i]) : lowest;
  };
  const int towards = major > 0.0 ? 1 : -1;
  for (int n = 1; n < lines; ++n) {
    const int line = towards > 0 ? lines - 1 - n : n;
    for (int place = 0; place < length; ++place) {
      const double crossing = place + slant;
      const int before = static_cast<int>(std::floor(crossing));
      if (before < 0 || before + 1 >= length) continue;
      const double first = top(line + towards, before);
      const double second = top(line + towards, before + 1);
      if (first == lowest || second == lowest) continue;
      shadow[index(line, place)] = first + (crossing - before) * (second - first) - drop;
    }
  }
  return shadow;
}

// The cosine between the light and the ground's normal; NaN where it is not known.
double LambertAt(const HeightGrid& grid, int column, int row, const Eigen::Vector3d& to_sun) {
  const int west = std::max(column - 1, 0);
  const int east = std::min(column + 1, grid.columns - 1);
  const int north = std::max(row - 1, 0);
  const int south = std::min(row + 1, grid.rows - 1);
  const double slope_x = (grid.At(east, row) - grid.At(west, row)) / ((east - west) * grid.spacing);
  const double slope_y =
      (grid.At(column, north) - grid.At(column, south)) / ((south - north) * grid.spacing);
  return to_sun.dot(Eigen::Vector3d(-slope_x, -slope_y, 1.0).normalized());
}

}  // namespace

Image ShadedRelief(const HeightGrid& grid, const ReliefLight& light, int largest) {
  REGOLITH_CHECK(grid.columns >= 2 && grid.rows >= 2, grid.columns, " x ", grid.rows);
  const HeightGrid thin = Thinned(grid, largest);
  const double azimuth = light.azimuth_deg * kDegree;
  const double elevation = light.elevation_deg * kDegree;
  const Eigen::Vector3d to_sun(std::sin(azimuth) * std::cos(elevation),
                               std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
  // Rows run to the south.
  const auto shadow = ShadowHeights(thin, {to_sun.x(), -to_sun.y()}, std::tan(elevation));
  std::vector<double> lit;
  std::vector<double> brightness(thin.heights.size(), std::nan(""));
  for (int row = 0; row < thin.rows; ++row) {
    for (int column = 0; column < thin.columns; ++column) {
      const size_t i = static_cast<size_t>(row) * static_cast<size_t>(thin.columns) +
                       static_cast<size_t>(column);
      if (!std::isfinite(thin.heights[i])) continue;
      const double cosine = LambertAt(thin, column, row, to_sun);
      if (!std::isfinite(cosine)) continue;
      brightness[i] = thin.heights[i] < shadow[i] ? 0.0 : std::max(cosine, 0.0);
      if (brightness[i] > 0.0) lit.push_back(brightness[i]);
    }
  }
  // The contrast of gentle ground is a few per cent: stretch between two percentiles.
  double dark = 0.0;
  double bright = 1.0;
  if (lit.size() > 100) {
    const auto percentile = [&](double share) {
      const auto place = lit.begin() + static_cast<std::ptrdiff_t>(
                                           share * (static_cast<double>(lit.size()) - 1.0));
      std::nth_element(lit.begin(), place, lit.end());
      return *place;
    };
    dark = percentile(0.01);
    bright = std::max(percentile(0.99), dark + 0.05);
  }
  Image image;
  image.width = thin.columns;
  image.height = thin.rows;
  for (const double value : brightness) {
    double level = 0.0;
    if (value == 0.0) level = kShadowLevel;
    if (value > 0.0) {
      const double share = std::clamp((value - dark) / (bright - dark), 0.0, 1.0);
      level = kDarkest + (kBrightest - kDarkest) * share;
    }
    image.data.push_back(static_cast<uint8_t>(std::lround(level)));
  }
  return image;
}

}  // namespace regolith
