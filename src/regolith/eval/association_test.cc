// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/association.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

namespace regolith {
namespace {

using Pairs = std::vector<std::pair<size_t, size_t>>;

std::vector<StampedPose> At(const std::vector<double>& seconds) {
  std::vector<StampedPose> poses;
  for (const double time : seconds) poses.push_back({FromSeconds(time), SE3()});
  return poses;
}

Pairs Associate(const std::vector<double>& reference, const std::vector<double>& estimate,
                double max_difference) {
  const std::vector<StampedPose> reference_poses = At(reference);
  const std::vector<StampedPose> estimate_poses = At(estimate);
  Pairs pairs;
  for (const PosePair& pair : AssociateByTime(reference_poses, estimate_poses, max_difference)) {
    pairs.emplace_back(pair.reference, pair.estimate);
  }
  return pairs;
}

// The expected pairs are those that evo_ape 1.38.1 makes (its error arrays show which).
TEST(Association, TheShorterSeriesChooses) {
  EXPECT_EQ(Associate({0, 1, 2, 3}, {0, 0.005, 0.008, 1, 2, 2.01, 3}, 0.01),
            (Pairs{{0, 0}, {1, 3}, {2, 4}, {3, 6}}));
  EXPECT_EQ(Associate({0, 0.005, 0.008, 1, 2, 2.01, 3}, {0.006, 1, 2.004, 3}, 0.01),
            (Pairs{{1, 0}, {3, 1}, {4, 2}, {6, 3}}));
}

TEST(Association, OfEquallyLongSeriesTheEstimateChoosesAndMayShareAReference) {
  EXPECT_EQ(Associate({0, 1, 2, 3}, {0.0, 0.01, 1.0, 2.0}, 0.01),
            (Pairs{{0, 0}, {0, 1}, {1, 2}, {2, 3}}));
}

TEST(Association, TheLimitIsInclusiveAndTheEarlierOfTwoEquallyNearWins) {
  const double limit = 0.015625;
  EXPECT_EQ(Associate({0, 1, 2, 3}, {limit, 1 + limit, 2.02, 3.0}, limit),
            (Pairs{{0, 0}, {1, 1}, {3, 3}}));
  EXPECT_EQ(Associate({1 - limit, 1 + limit, 2, 3}, {1, 2}, limit), (Pairs{{0, 0}, {2, 1}}));
}

TEST(Association, OfRepeatedStampsTheOneNextToTheTimeSoughtWins) {
  const std::vector<double> estimate = {1, 2, 3, 4};
  EXPECT_EQ(Associate({0, 0.99, 1, 1, 1, 2, 3, 4}, estimate, 0.02),
            (Pairs{{4, 0}, {5, 1}, {6, 2}, {7, 3}}));
  EXPECT_EQ(Associate({0.99, 0.99, 0.99, 2, 3, 4}, estimate, 0.02),
            (Pairs{{2, 0}, {3, 1}, {4, 2}, {5, 3}}));
  EXPECT_EQ(Associate({1.01, 1.01, 1.01, 2, 3, 4}, estimate, 0.02),
            (Pairs{{0, 0}, {3, 1}, {4, 2}, {5, 3}}));
  EXPECT_EQ(Associate({1, 2, 3, 4}, {1.01, 1.01, 1.99, 1.99, 3, 4, 4, 4}, 0.02),
            (Pairs{{0, 0}, {1, 3}, {2, 4}, {3, 7}}));
}

TEST(Association, OfNothingIsNothing) {
  EXPECT_TRUE(Associate({}, {1.0}, 0.01).empty());
  EXPECT_TRUE(Associate({1.0}, {}, 0.01).empty());
  EXPECT_TRUE(Associate({1.0}, {2.0}, 0.01).empty());
}

}  // namespace
}  // namespace regolith
