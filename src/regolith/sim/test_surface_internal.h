// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "regolith/terrain/rock_shapes.h"
#include "regolith/terrain/surface.h"

namespace regolith {

/// Ground for tests: a height in closed form, known within 70 m, and rocks one by one.
class TestSurface : public Surface {
 public:
  using HeightOf = std::function<double(double x, double y)>;

  explicit TestSurface(HeightOf height) : height_(std::move(height)) {}

  void Add(const Eigen::Vector2d& centre, double diameter, uint32_t shape = 0) {
    Rock rock;
    rock.centre = centre;
    rock.diameter = diameter;
    rock.ground = height_(centre.x(), centre.y());
    rock.shape = shape;
    rocks_.push_back(rock);
  }

  double Height(double x, double y, double) const override { return height_(x, y); }
  double Albedo(double, double, double) const override { return 0.1; }
  bool Known(double x, double y, double margin) const override {
    return std::max(std::abs(x), std::abs(y)) + margin < kHalf;
  }
  Eigen::AlignedBox2d box() const override {
    return {Eigen::Vector2d(-kHalf, -kHalf), Eigen::Vector2d(kHalf, kHalf)};
  }
  std::vector<Rock> Rocks(const Eigen::AlignedBox2d& area, double min_diameter) const override {
    std::vector<Rock> found;
    for (const Rock& rock : rocks_) {
      if (rock.diameter >= min_diameter && area.contains(rock.centre)) found.push_back(rock);
    }
    return found;
  }
  std::vector<RockShape> RockShapes() const override { return shapes_; }

 private:
  static constexpr double kHalf = 70.0;

  HeightOf height_;
  std::vector<Rock> rocks_;
  std::vector<RockShape> shapes_ = MakeRockShapes(0.5);
};

}  // namespace regolith
