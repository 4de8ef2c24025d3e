// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/score_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace regolith {
namespace {

constexpr int kChannels = 65;

std::vector<float> RandomLogits(int cells, float spread) {
  std::mt19937 generator(7);
  std::normal_distribution<float> normal(0.0F, spread);
  std::vector<float> logits(static_cast<size_t>(cells) * kChannels);
  for (float& value : logits) value = normal(generator);
  return logits;
}

ScoreMap RandomMap(int width, int height) {
  std::mt19937 generator(11);
  // Few levels, so that equal scores meet.
  std::uniform_int_distribution<int> level(0, 40);
  ScoreMap map{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    map.scores.push_back(static_cast<float>(level(generator)) / 40.0F);
  }
  return map;
}

TEST(MakeScoreMap, IsTheSoftmaxOfEachCellLaidOutInTheImage) {
  const std::vector<float> logits = RandomLogits(2 * 3, 3.0F);
  NetworkOutput output;
  output.rows = 2;
  output.columns = 3;
  output.logits = logits.data();
  ScoreMap map;
  MakeScoreMap(output, 21, 13, &map);  // three columns and three rows of padding
  ASSERT_EQ(map.scores.size(), 21U * 13U);
  for (int y = 0; y < 13; ++y) {
    for (int x = 0; x < 21; ++x) {
      const float* cell = logits.data() + ((y / 8) * 3 + x / 8) * kChannels;
      double sum = 0.0;
      for (int c = 0; c < kChannels; ++c) sum += std::exp(static_cast<double>(cell[c]));
      const double expected = std::exp(static_cast<double>(cell[(y % 8) * 8 + x % 8])) / sum;
      EXPECT_NEAR(map.scores[static_cast<size_t>(y * 21 + x)], expected, 1e-6) << x << ", " << y;
    }
  }
}

TEST(AddNeighbours, AddsThreeByThreePixelsAndEndsAtTheEdges) {
  ScoreMap map;
  map.width = 4;
  map.height = 3;
  map.scores = {1.0F, 2.0F, 4.0F, 8.0F, 0.0F, 0.0F, 0.5F, 0.0F, 16.0F, 0.0F, 0.0F, 32.0F};
  ScoreMap sums;
  AddNeighbours(map, &sums);
  EXPECT_EQ(sums.scores, (std::vector<float>{3.0F, 7.5F, 14.5F, 12.5F, 19.0F, 23.5F, 46.5F, 44.5F,
                                             16.0F, 16.5F, 32.5F, 32.5F}));
}

TEST(MakeScoreMap, StandsLargeLogits) {
  std::vector<float> logits(kChannels, -500.0F);
  logits[9] = 900.0F;
  NetworkOutput output;
  output.rows = output.columns = 1;
  output.logits = logits.data();
  ScoreMap map;
  MakeScoreMap(output, 8, 8, &map);
  EXPECT_FLOAT_EQ(map.scores[9], 1.0F);
  EXPECT_LT(map.scores[0], 1e-30F);
}

std::vector<Candidate> NaiveSuppression(const ScoreMap& map, const SuppressionOptions& options) {
  std::vector<Candidate> all;
  for (int y = options.border; y < map.height - options.border; ++y) {
    for (int x = options.border; x < map.width - options.border; ++x) {
      const float score = map.scores[static_cast<size_t>(y * map.width + x)];
      if (score > options.floor) all.push_back({x, y, score});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  std::vector<Candidate> kept;
  for (const Candidate& one : all) {
    const bool near = std::any_of(kept.begin(), kept.end(), [&](const Candidate& other) {
      return std::abs(other.column - one.column) <= options.radius &&
             std::abs(other.row - one.row) <= options.radius;
    });
    if (!near) kept.push_back(one);
  }
  return kept;
}

TEST(NonMaximumSuppression, IsExactlyTheGreedyOne) {
  const ScoreMap map = RandomMap(71, 53);
  SuppressionOptions options;
  options.floor = 0.2F;
  NonMaximumSuppression suppression;
  std::vector<Candidate> found;
  for (const int radius : {1, 3, 4, 9}) {
    options.radius = radius;
    suppression.Run(map, nullptr, options, &found);
    const std::vector<Candidate> expected = NaiveSuppression(map, options);
    ASSERT_EQ(found.size(), expected.size()) << radius;
    for (size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].column, expected[i].column);
      EXPECT_EQ(found[i].row, expected[i].row);
      EXPECT_EQ(found[i].score, expected[i].score);
    }
  }
}

TEST(NonMaximumSuppression, LeavesWhatIsMaskedAndSmallImagesAlone) {
  const ScoreMap map = RandomMap(40, 40);
  Image mask{40, 40, std::vector<uint8_t>(1600, 255)};
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 20; ++x) mask.data[static_cast<size_t>(y * 40 + x)] = 0;
  }
  NonMaximumSuppression suppression;
  std::vector<Candidate> found;
  suppression.Run(map, &mask, SuppressionOptions(), &found);
  ASSERT_FALSE(found.empty());
  for (const Candidate& one : found) EXPECT_GE(one.column, 20);
  for (const int side : {0, 1, 2, 8}) {
    const ScoreMap small{side, side, std::vector<float>(static_cast<size_t>(side * side), 0.5F)};
    suppression.Run(small, nullptr, SuppressionOptions(), &found);
    EXPECT_TRUE(found.empty()) << side;
  }
}

TEST(RefinePixel, FindsTheCentreOfASpreadPoint) {
  // A point at (5.25, 3.5) shared among its four pixels.
  ScoreMap map{10, 8, std::vector<float>(80, 0.0F)};
  map.scores[3 * 10 + 5] = 0.75F * 0.5F;
  map.scores[3 * 10 + 6] = 0.25F * 0.5F;
  map.scores[4 * 10 + 5] = 0.75F * 0.5F;
  map.scores[4 * 10 + 6] = 0.25F * 0.5F;
  const Eigen::Vector2f pixel = RefinePixel(map, {5, 3, 0.375F});
  EXPECT_NEAR(pixel.x(), 5.25, 1e-6);
  EXPECT_NEAR(pixel.y(), 3.5, 1e-6);
}

}  // namespace
}  // namespace regolith
