// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

namespace regolith {

/// Scrambles 64 bits so that neighbouring inputs give unrelated outputs (SplitMix64, Steele et al.
/// 2014).
inline uint64_t Scramble(uint64_t value) {
  value += 0x9e3779b97f4a7c15ULL;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

/// A value in [0, 1) that depends on nothing but its arguments: the same noise whatever the order
/// of the work.
double HashUniform(uint64_t seed, uint64_t first, uint64_t second = 0, uint64_t third = 0);

/// A standard normal value that depends on nothing but its arguments.
double HashGaussian(uint64_t seed, uint64_t first, uint64_t second = 0, uint64_t third = 0);

/// A seeded generator whose values are the same on every platform (the standard library's
/// distributions are not). Give each purpose a stream of its own, so that one more draw in one
/// place does not change the others.
class Random {
 public:
  explicit Random(uint64_t seed);
  Random(uint64_t seed, std::string_view stream);

  uint64_t Next();
  /// Uniform in [low, high).
  double Uniform(double low = 0.0, double high = 1.0);
  double Gaussian(double mean = 0.0, double sigma = 1.0);
  /// Poisson-distributed count; exact below a mean of 30, rounded normal above.
  int64_t Poisson(double mean);

 private:
  uint64_t state_;
};

/// A seed for the stream called `name` of `seed`.
uint64_t StreamSeed(uint64_t seed, std::string_view name);

}  // namespace regolith
