// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regolith {
namespace {

struct Moments {
  double mean = 0.0;
  double sigma = 0.0;
};

template <typename Draw>
Moments MomentsOf(Draw draw, int count) {
  double sum = 0.0;
  double sum_squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double value = draw(i);
    sum += value;
    sum_squares += value * value;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(sum_squares / count - mean * mean)};
}

TEST(Random, SameSeedSameValuesAndStreamsDiffer) {
  Random first(7, "imu");
  Random same(7, "imu");
  Random other(7, "lidar");
  const uint64_t value = first.Next();
  EXPECT_EQ(value, same.Next());
  EXPECT_NE(value, other.Next());
}

TEST(Random, GaussianHasTheMomentsAskedFor) {
  Random random(1);
  const Moments moments = MomentsOf([&](int) { return random.Gaussian(2.0, 3.0); }, 100000);
  EXPECT_NEAR(moments.mean, 2.0, 0.05);
  EXPECT_NEAR(moments.sigma, 3.0, 0.05);
}

TEST(Random, HashedNoiseIsStandardNormalAcrossIndices) {
  const Moments moments =
      MomentsOf([](int i) { return HashGaussian(3, static_cast<uint64_t>(i)); }, 100000);
  EXPECT_NEAR(moments.mean, 0.0, 0.02);
  EXPECT_NEAR(moments.sigma, 1.0, 0.02);
}

TEST(Random, PoissonMeanHoldsBelowAndAboveTheSwitch) {
  Random random(5);
  for (const double mean : {0.3, 12.0, 200.0}) {
    const Moments moments =
        MomentsOf([&](int) { return static_cast<double>(random.Poisson(mean)); }, 20000);
    EXPECT_NEAR(moments.mean, mean, 0.03 * mean) << mean;
    EXPECT_NEAR(moments.sigma, std::sqrt(mean), 0.05 * std::sqrt(mean)) << mean;
  }
}

}  // namespace
}  // namespace regolith
