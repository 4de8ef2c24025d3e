// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/adaptive_threshold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace regolith {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

/// Candidates of which the left half of the image is `contrast` times as strong as the right one.
std::vector<Candidate> TwoHalves(int count, float contrast, int seed) {
  std::mt19937 generator(static_cast<unsigned>(seed));
  std::uniform_int_distribution<int> column(4, kWidth - 5);
  std::uniform_int_distribution<int> row(4, kHeight - 5);
  std::uniform_real_distribution<float> strength(0.01F, 0.05F);
  std::vector<Candidate> candidates;
  for (int i = 0; i < count; ++i) {
    Candidate one{column(generator), row(generator), strength(generator)};
    if (one.column < kWidth / 2) one.score *= contrast;
    candidates.push_back(one);
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return candidates;
}

int CountRight(const std::vector<Candidate>& candidates) {
  return static_cast<int>(
      std::count_if(candidates.begin(), candidates.end(),
                    [](const Candidate& one) { return one.column >= kWidth / 2; }));
}

TEST(AdaptiveThreshold, MeetsTheNumberAskedForWhereThereAreEnough) {
  AdaptiveThreshold threshold((AdaptiveThresholdOptions()));
  for (int frame = 0; frame < 10; ++frame) {
    std::vector<Candidate> candidates = TwoHalves(1500, frame % 2 == 0 ? 8.0F : 1.0F, frame);
    threshold.Select(kWidth, kHeight, 400, &candidates);
    EXPECT_EQ(candidates.size(), 400U) << frame;
    EXPECT_TRUE(
        std::is_sorted(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.score > b.score; }));
  }
  std::vector<Candidate> few = TwoHalves(100, 8.0F, 3);
  threshold.Select(kWidth, kHeight, 400, &few);
  EXPECT_EQ(few.size(), 100U);
}

TEST(AdaptiveThreshold, SpreadsMoreEvenlyThanOneThreshold) {
  AdaptiveThresholdOptions options;
  std::vector<int> right;
  for (const double evenness : {0.0, 0.5, 1.0}) {
    options.evenness = evenness;
    AdaptiveThreshold threshold(options);
    std::vector<Candidate> candidates = TwoHalves(1500, 2.5F, 1);
    threshold.Select(kWidth, kHeight, 400, &candidates);
    right.push_back(CountRight(candidates));
  }
  EXPECT_LT(right[0], 60);  // what each cell's strongest are
  EXPECT_GT(right[1], right[0] + 10);
  EXPECT_NEAR(right[2], 200, 20);
}

TEST(AdaptiveThreshold, FillsEveryCellThatHasACandidate) {
  AdaptiveThreshold threshold((AdaptiveThresholdOptions()));
  std::vector<Candidate> candidates = TwoHalves(3000, 50.0F, 1);
  threshold.Select(kWidth, kHeight, 400, &candidates);
  EXPECT_EQ(threshold.status().cells, 8 * 6);
  EXPECT_EQ(threshold.status().cells_filled, 8 * 6);
}

TEST(AdaptiveThreshold, MovesFromFrameToFrame) {
  AdaptiveThresholdOptions options;
  options.memory = 0.9;
  AdaptiveThreshold threshold(options);
  std::vector<Candidate> bright = TwoHalves(1500, 1.0F, 1);
  threshold.Select(kWidth, kHeight, 400, &bright);
  const double before = threshold.status().threshold_median;
  std::vector<Candidate> dark = TwoHalves(1500, 1.0F, 1);
  for (Candidate& one : dark) one.score *= 0.5F;
  threshold.Select(kWidth, kHeight, 400, &dark);
  EXPECT_EQ(dark.size(), 400U);
  EXPECT_EQ(threshold.status().rounds, 1);
  EXPECT_NEAR(threshold.status().threshold_median, 0.5 * before, 0.1 * before);
}

TEST(AdaptiveThreshold, OffItIsOneThresholdAndTheBestFirst) {
  AdaptiveThresholdOptions options;
  options.enabled = false;
  options.initial = 0.03;
  AdaptiveThreshold threshold(options);
  std::vector<Candidate> candidates = TwoHalves(1000, 1.0F, 1);
  const auto above = std::count_if(candidates.begin(), candidates.end(),
                                   [](const Candidate& one) { return one.score >= 0.03F; });
  std::vector<Candidate> all = candidates;
  threshold.Select(kWidth, kHeight, 1000, &all);
  EXPECT_EQ(static_cast<int64_t>(all.size()), above);
  threshold.Select(kWidth, kHeight, 50, &candidates);
  EXPECT_EQ(candidates.size(), 50U);
  EXPECT_EQ(candidates.back().score, all[49].score);
}

TEST(AdaptiveThreshold, StandsNoCandidates) {
  AdaptiveThreshold threshold((AdaptiveThresholdOptions()));
  std::vector<Candidate> none;
  threshold.Select(1, 1, 400, &none);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(threshold.status().cells_filled, 0);
}

}  // namespace
}  // namespace regolith
