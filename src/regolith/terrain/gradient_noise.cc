// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/gradient_noise.h"

#include <algorithm>
#include <cmath>

#include "regolith/terrain/lattice_hash_internal.h"

namespace regolith {
namespace {

// So few posts share an integer base that single precision resolves their places.
constexpr int kRun = 128;

template <typename Real>
Real Fade(Real t) {
  return t * t * t * (t * (t * Real{6} - Real{15}) + Real{10});
}

// The dot product of a corner's gradient, uniform in [-1, 1)², with the way from it.
template <typename Real>
Real Corner(uint32_t key, Real dx, Real dy) {
  constexpr Real kScale = Real{1} / Real{32768};
  const uint32_t hash = LatticeHash(key);
  const Real gradient_x =
      static_cast<Real>(static_cast<int32_t>(hash & 0xffffU)) * kScale - Real{1};
  const Real gradient_y = static_cast<Real>(static_cast<int32_t>(hash >> 16)) * kScale - Real{1};
  return gradient_x * dx + gradient_y * dy;
}

template <typename Real>
Real Blend(uint32_t key, Real dx, Real dy) {
  const Real low_left = Corner(key, dx, dy);
  const Real low_right = Corner(key + kColumnFactor, dx - Real{1}, dy);
  const Real high_left = Corner(key + kRowFactor, dx, dy - Real{1});
  const Real high_right = Corner(key + kColumnFactor + kRowFactor, dx - Real{1}, dy - Real{1});
  const Real fade_x = Fade(dx);
  const Real low = low_left + fade_x * (low_right - low_left);
  const Real high = high_left + fade_x * (high_right - high_left);
  return low + Fade(dy) * (high - low);
}

uint32_t Wrapped(double integer) { return static_cast<uint32_t>(static_cast<int64_t>(integer)); }

template <typename Real>
void AddRun(uint32_t seed, const NoiseRow& row, Real amplitude, Real* out) {
  // From the lowest integers of the run every way is positive, so that truncation is floor.
  const double base_x = std::floor(std::min(row.x, row.x + row.count * row.step_x));
  const double base_y = std::floor(std::min(row.y, row.y + row.count * row.step_y));
  const uint32_t key = seed + Wrapped(base_x) * kColumnFactor + Wrapped(base_y) * kRowFactor;
  const auto x = static_cast<Real>(row.x - base_x);
  const auto y = static_cast<Real>(row.y - base_y);
  const auto step_x = static_cast<Real>(row.step_x);
  const auto step_y = static_cast<Real>(row.step_y);
  for (int i = 0; i < row.count; ++i) {
    const Real u = x + static_cast<Real>(i) * step_x;
    const Real v = y + static_cast<Real>(i) * step_y;
    const auto column = static_cast<int32_t>(u);
    const auto line = static_cast<int32_t>(v);
    const uint32_t corner = key + static_cast<uint32_t>(column) * kColumnFactor +
                            static_cast<uint32_t>(line) * kRowFactor;
    out[i] += amplitude * Blend(corner, u - static_cast<Real>(column), v - static_cast<Real>(line));
  }
}

// A run within one cell of the lattice: four gradients, then arithmetic alone.
void AddCell(uint32_t key, double x, double y, const NoiseRow& row, double amplitude, double* out) {
  double gradient_x[4];
  double gradient_y[4];
  const uint32_t keys[] = {key, key + kColumnFactor, key + kRowFactor,
                           key + kColumnFactor + kRowFactor};
  for (int k = 0; k < 4; ++k) {
    gradient_x[k] = Corner(keys[k], 1.0, 0.0);
    gradient_y[k] = Corner(keys[k], 0.0, 1.0);
  }
  for (int i = 0; i < row.count; ++i) {
    const double dx = x + i * row.step_x;
    const double dy = y + i * row.step_y;
    const double low_left = gradient_x[0] * dx + gradient_y[0] * dy;
    const double low_right = gradient_x[1] * (dx - 1.0) + gradient_y[1] * dy;
    const double high_left = gradient_x[2] * dx + gradient_y[2] * (dy - 1.0);
    const double high_right = gradient_x[3] * (dx - 1.0) + gradient_y[3] * (dy - 1.0);
    const double fade_x = Fade(dx);
    const double low = low_left + fade_x * (low_right - low_left);
    const double high = high_left + fade_x * (high_right - high_left);
    out[i] += amplitude * (low + Fade(dy) * (high - low));
  }
}

// Long waves, which need double precision, have many posts to a cell: halves until they share one.
void AddLongRun(uint32_t seed, const NoiseRow& row, double amplitude, double* out) {
  constexpr int kFewest = 8;
  const double column = std::floor(row.x);
  const double line = std::floor(row.y);
  const int last = row.count - 1;
  if (std::floor(row.x + last * row.step_x) == column &&
      std::floor(row.y + last * row.step_y) == line) {
    const uint32_t key = seed + Wrapped(column) * kColumnFactor + Wrapped(line) * kRowFactor;
    AddCell(key, row.x - column, row.y - line, row, amplitude, out);
  } else if (row.count < kFewest) {
    AddRun(seed, row, amplitude, out);
  } else {
    const int half = row.count / 2;
    NoiseRow first = row;
    first.count = half;
    const NoiseRow second{row.x + half * row.step_x, row.y + half * row.step_y, row.step_x,
                          row.step_y, row.count - half};
    AddLongRun(seed, first, amplitude, out);
    AddLongRun(seed, second, amplitude, out + half);
  }
}

}  // namespace

double GradientNoise(uint32_t seed, double x, double y) {
  const double floor_x = std::floor(x);
  const double floor_y = std::floor(y);
  return Blend(seed + Wrapped(floor_x) * kColumnFactor + Wrapped(floor_y) * kRowFactor, x - floor_x,
               y - floor_y);
}

void AddGradientNoise(uint32_t seed, const NoiseRow& row, float amplitude, float* out) {
  for (int first = 0; first < row.count; first += kRun) {
    const NoiseRow run{row.x + first * row.step_x, row.y + first * row.step_y, row.step_x,
                       row.step_y, std::min(kRun, row.count - first)};
    AddRun(seed, run, amplitude, out + first);
  }
}

void AddGradientNoise(uint32_t seed, const NoiseRow& row, double amplitude, double* out) {
  if (row.count > 0) AddLongRun(seed, row, amplitude, out);
}

}  // namespace regolith
