// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/core/random.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// A plane of random spots for tests, seen as from above by a camera that shifts and turns.
class TestTexture {
 public:
  explicit TestTexture(uint64_t seed, int size = 1200, int spots = 9000) : size_(size) {
    grey_.assign(static_cast<size_t>(size) * static_cast<size_t>(size), 110.0F);
    Random random(seed);
    for (int i = 0; i < spots; ++i) AddSpot(&random);
  }

  /// The image whose pixel p shows the texture at centre + R(turn) (p − middle) + shift.
  Image View(int width, int height, const Eigen::Vector2d& shift, double turn = 0.0) const {
    Image image{width, height, {}};
    image.data.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const Eigen::Vector2d place = InTexture(width, height, {column, row}, shift, turn);
        image.data[static_cast<size_t>(row) * static_cast<size_t>(width) +
                   static_cast<size_t>(column)] =
            static_cast<uint8_t>(std::clamp(std::lround(At(place)), 0L, 255L));
      }
    }
    return image;
  }

  Eigen::Vector2d InTexture(int width, int height, const Eigen::Vector2d& pixel,
                            const Eigen::Vector2d& shift, double turn) const {
    const Eigen::Vector2d middle(0.5 * (width - 1), 0.5 * (height - 1));
    return Eigen::Vector2d::Constant(0.5 * size_) + shift +
           Eigen::Rotation2Dd(turn) * (pixel - middle);
  }

 private:
  size_t Index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(size_) + static_cast<size_t>(x);
  }

  void AddSpot(Random* random) {
    const Eigen::Vector2d centre(random->Uniform(0.0, size_), random->Uniform(0.0, size_));
    const double radius = random->Uniform(1.5, 6.0);
    const double height = random->Uniform(-60.0, 60.0);
    const int reach = static_cast<int>(3.0 * radius);
    for (int y = std::max(0, static_cast<int>(centre.y()) - reach);
         y < std::min(size_, static_cast<int>(centre.y()) + reach); ++y) {
      for (int x = std::max(0, static_cast<int>(centre.x()) - reach);
           x < std::min(size_, static_cast<int>(centre.x()) + reach); ++x) {
        // Steeper than a Gaussian, so that there are edges and corners.
        const double square = (Eigen::Vector2d(x, y) - centre).squaredNorm() / (radius * radius);
        grey_[Index(x, y)] += static_cast<float>(height / (1.0 + square * square * square));
      }
    }
  }

  double At(const Eigen::Vector2d& place) const {
    const int x = std::clamp(static_cast<int>(std::floor(place.x())), 0, size_ - 2);
    const int y = std::clamp(static_cast<int>(std::floor(place.y())), 0, size_ - 2);
    const double u = std::clamp(place.x() - x, 0.0, 1.0);
    const double v = std::clamp(place.y() - y, 0.0, 1.0);
    const auto grey = [&](int column, int row) {
      return static_cast<double>(grey_[Index(column, row)]);
    };
    return (1.0 - v) * ((1.0 - u) * grey(x, y) + u * grey(x + 1, y)) +
           v * ((1.0 - u) * grey(x, y + 1) + u * grey(x + 1, y + 1));
  }

  int size_;
  std::vector<float> grey_;
};

/// An image of one grey.
inline Image FlatImage(int width, int height, uint8_t grey) {
  return {width, height,
          std::vector<uint8_t>(static_cast<size_t>(width) * static_cast<size_t>(height), grey)};
}

}  // namespace regolith
