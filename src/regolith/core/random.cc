// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/random.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr uint64_t kGoldenGamma = 0x9e3779b97f4a7c15ULL;
constexpr double kTwoPi = 6.283185307179586;

double ToUnit(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

// Box and Muller 1958; 1 - u keeps the logarithm's argument above zero.
double BoxMuller(double first_uniform, double second_uniform) {
  return std::sqrt(-2.0 * std::log(1.0 - first_uniform)) * std::cos(kTwoPi * second_uniform);
}

uint64_t HashBits(uint64_t seed, uint64_t first, uint64_t second, uint64_t third) {
  return Scramble(Scramble(Scramble(Scramble(seed) ^ first) ^ second) ^ third);
}

}  // namespace

double HashUniform(uint64_t seed, uint64_t first, uint64_t second, uint64_t third) {
  return ToUnit(HashBits(seed, first, second, third));
}

double HashGaussian(uint64_t seed, uint64_t first, uint64_t second, uint64_t third) {
  const uint64_t bits = HashBits(seed, first, second, third);
  return BoxMuller(ToUnit(bits), ToUnit(Scramble(bits)));
}

uint64_t StreamSeed(uint64_t seed, std::string_view name) {
  uint64_t hash = Scramble(seed);
  for (const char letter : name) hash = Scramble(hash ^ static_cast<unsigned char>(letter));
  return hash;
}

Random::Random(uint64_t seed) : state_(Scramble(seed)) {}

Random::Random(uint64_t seed, std::string_view stream) : Random(StreamSeed(seed, stream)) {}

uint64_t Random::Next() {
  const uint64_t value = Scramble(state_);
  state_ += kGoldenGamma;
  return value;
}

double Random::Uniform(double low, double high) { return low + (high - low) * ToUnit(Next()); }

double Random::Gaussian(double mean, double sigma) {
  const double first = ToUnit(Next());
  return mean + sigma * BoxMuller(first, ToUnit(Next()));
}

int64_t Random::Poisson(double mean) {
  REGOLITH_CHECK(mean >= 0.0, "mean=", mean);
  if (mean > 30.0) return std::max<int64_t>(0, std::llround(Gaussian(mean, std::sqrt(mean))));
  // Knuth 1969: count uniform factors until their product falls below exp(-mean).
  const double limit = std::exp(-mean);
  int64_t count = 0;
  double product = Uniform();
  while (product > limit) {
    ++count;
    product *= Uniform();
  }
  return count;
}

}  // namespace regolith
