// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/gradient_noise.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace regolith {
namespace {

constexpr int kDirectionBits = 8;
constexpr size_t kDirections = size_t{1} << kDirectionBits;

struct Direction {
  double x;
  double y;
};

std::array<Direction, kDirections> MakeDirections() {
  std::array<Direction, kDirections> directions{};
  for (size_t i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * M_PI * (static_cast<double>(i) + 0.5) / kDirections;
    directions[i] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}

// A multiply–xor hash of two lattice coordinates; four are needed for each value, so it is kept
// shorter than Scramble of core.
uint64_t LatticeHash(uint64_t seed, int64_t column, int64_t row) {
  uint64_t hash = seed ^ (static_cast<uint64_t>(column) * 0x9e3779b97f4a7c15ULL) ^
                  (static_cast<uint64_t>(row) * 0xc2b2ae3d27d4eb4fULL);
  hash = (hash ^ (hash >> 32)) * 0xd6e8feb86659fd93ULL;
  return hash ^ (hash >> 29);
}

double Corner(uint64_t seed, int64_t column, int64_t row, double dx, double dy) {
  static const std::array<Direction, kDirections> kTable = MakeDirections();
  const Direction& gradient = kTable[(LatticeHash(seed, column, row) >> 20) & (kDirections - 1)];
  return gradient.x * dx + gradient.y * dy;
}

double Fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

}  // namespace

double GradientNoise(uint64_t seed, double x, double y) {
  const double floor_x = std::floor(x);
  const double floor_y = std::floor(y);
  const auto column = static_cast<int64_t>(floor_x);
  const auto row = static_cast<int64_t>(floor_y);
  const double dx = x - floor_x;
  const double dy = y - floor_y;
  const double fade_x = Fade(dx);
  const double low_left = Corner(seed, column, row, dx, dy);
  const double low_right = Corner(seed, column + 1, row, dx - 1.0, dy);
  const double high_left = Corner(seed, column, row + 1, dx, dy - 1.0);
  const double high_right = Corner(seed, column + 1, row + 1, dx - 1.0, dy - 1.0);
  const double low = low_left + fade_x * (low_right - low_left);
  const double high = high_left + fade_x * (high_right - high_left);
  return low + Fade(dy) * (high - low);
}

}  // namespace regolith
