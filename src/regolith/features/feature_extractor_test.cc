// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/feature_extractor.h"

#include <cmath>

#include <gtest/gtest.h>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/features/descriptor_matcher.h"
#include "regolith/features/keypoint_grid.h"
#include "regolith/features/test_texture_internal.h"

namespace regolith {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kCount = 500;

std::unique_ptr<FeatureExtractor> Extractor(const std::string& name) {
  FeatureOptions options;
  options.frontend = name;
  return FeatureExtractor::Create(options, std::nullopt);
}

FeatureSet Extracted(FeatureExtractor& extractor, const Image& image, const Image* mask = nullptr) {
  FeatureSet features;
  extractor.Extract(image, mask, kCount, &features);
  return features;
}

class HandmadeExtractors : public testing::TestWithParam<std::string> {};

TEST_P(HandmadeExtractors, SpreadKeypointsOverTheWholeImage) {
  const TestTexture texture(1);
  const auto extractor = Extractor(GetParam());
  const FeatureSet features = Extracted(*extractor, texture.View(kWidth, kHeight, {0, 0}));
  EXPECT_GT(features.size(), 450U);
  EXPECT_LE(features.size(), 500U);
  EXPECT_EQ(extractor->status().cells, 48);
  EXPECT_EQ(extractor->status().cells_filled, 48);
  std::vector<int> in_cell(48, 0);
  const KeypointGrid grid(kWidth, kHeight, 80);
  for (const auto& pixel : features.pixels) ++in_cell[static_cast<size_t>(grid.CellOf(pixel))];
  // The even share is 10.
  EXPECT_LE(*std::max_element(in_cell.begin(), in_cell.end()), 15);
  for (size_t i = 1; i < features.size(); ++i) {
    EXPECT_GE(features.scores[i - 1], features.scores[i]);
  }
}

TEST_P(HandmadeExtractors, KeepOffTheMaskAndTheBorder) {
  const TestTexture texture(2);
  Image mask = FlatImage(kWidth, kHeight, 255);
  for (int row = 240; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      mask.data[static_cast<size_t>(row * kWidth + column)] = 0;
    }
  }
  const auto extractor = Extractor(GetParam());
  const FeatureSet features = Extracted(*extractor, texture.View(kWidth, kHeight, {0, 0}), &mask);
  EXPECT_GT(features.size(), 200U);
  for (const auto& pixel : features.pixels) {
    EXPECT_LT(pixel.y(), 239.5F);
    EXPECT_GE(pixel.x(), 3.5F);
    EXPECT_LE(pixel.x(), 635.5F);
  }
}

TEST_P(HandmadeExtractors, GiveNothingWhereThereIsNothing) {
  const auto extractor = Extractor(GetParam());
  for (const auto& [width, height] : {std::pair(kWidth, kHeight),
                                      {1, 1},
                                      {0, 0},
                                      {2, 300},
                                      {3, 3},
                                      {39, 39},
                                      {40, 40},
                                      {41, 640},
                                      {5000, 1}}) {
    for (const uint8_t grey : {uint8_t{0}, uint8_t{255}}) {
      const FeatureSet features = Extracted(*extractor, FlatImage(width, height, grey));
      EXPECT_EQ(features.size(), 0U) << width << " × " << height;
      EXPECT_EQ(extractor->status().cells_filled, 0);
    }
  }
}

TEST_P(HandmadeExtractors, TakeAnySizeOfImage) {
  const TestTexture texture(3);
  const auto extractor = Extractor(GetParam());
  for (const auto& [width, height] : {std::pair(61, 77), {63, 640}, {333, 77}, {1024, 1024}}) {
    const FeatureSet features = Extracted(*extractor, texture.View(width, height, {0, 0}));
    EXPECT_GT(features.size(), 0U) << width << " × " << height;
    for (const auto& pixel : features.pixels) {
      EXPECT_TRUE(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < static_cast<float>(width) &&
                  pixel.y() < static_cast<float>(height));
    }
  }
}

TEST_P(HandmadeExtractors, GiveTheSameForTheSameImage) {
  const TestTexture texture(4);
  const Image image = texture.View(kWidth, kHeight, {0, 0});
  const auto one = Extractor(GetParam());
  const auto other = Extractor(GetParam());
  Extracted(*other, texture.View(800, 600, {50, 50}));
  const FeatureSet first = Extracted(*one, image);
  const FeatureSet second = Extracted(*other, image);
  EXPECT_EQ(first.pixels, second.pixels);
  EXPECT_EQ(first.scores, second.scores);
  EXPECT_EQ(first.descriptors.bits, second.descriptors.bits);
}

TEST_P(HandmadeExtractors, FindTheSamePlacesAfterAShift) {
  const TestTexture texture(5);
  const auto extractor = Extractor(GetParam());
  const Eigen::Vector2d shift(17.3, -8.6);
  const FeatureSet first = Extracted(*extractor, texture.View(kWidth, kHeight, {0, 0}));
  const FeatureSet second = Extracted(*extractor, texture.View(kWidth, kHeight, shift));
  int inside = 0;
  int repeated = 0;
  for (const auto& pixel : first.pixels) {
    const Eigen::Vector2f expected = pixel - shift.cast<float>();
    if (expected.x() < 20 || expected.y() < 20 || expected.x() > 620 || expected.y() > 460)
      continue;
    ++inside;
    for (const auto& other : second.pixels) {
      if ((other - expected).norm() < 2.0F) {
        ++repeated;
        break;
      }
    }
  }
  RecordProperty("repeated_percent", 100 * repeated / inside);
  EXPECT_GT(repeated, inside * 0.6);
}

INSTANTIATE_TEST_SUITE_P(All, HandmadeExtractors, testing::Values("orb", "st_lk"));

TEST(OrbExtractor, DescriptorsMatchUnderShiftAndTurn) {
  const TestTexture texture(6);
  const auto extractor = Extractor("orb");
  const Eigen::Vector2d shift(11.4, 6.8);
  constexpr double kTurn = 0.5;
  const FeatureSet first = Extracted(*extractor, texture.View(kWidth, kHeight, {0, 0}));
  const FeatureSet second = Extracted(*extractor, texture.View(kWidth, kHeight, shift, kTurn));
  ASSERT_EQ(first.descriptors.size(), first.size());
  DescriptorMatcher matcher{DescriptorMatcherOptions()};
  std::vector<FeatureMatch> matches;
  matcher.Match(first.descriptors, second.descriptors, &matches);
  int right = 0;
  double squares = 0.0;
  for (const FeatureMatch& match : matches) {
    const Eigen::Vector2d error =
        texture.InTexture(kWidth, kHeight,
                          first.pixels[static_cast<size_t>(match.first)].cast<double>(), {0, 0},
                          0.0) -
        texture.InTexture(kWidth, kHeight,
                          second.pixels[static_cast<size_t>(match.second)].cast<double>(), shift,
                          kTurn);
    if (error.norm() > 3.0) continue;
    ++right;
    squares += error.squaredNorm();
  }
  RecordProperty("matches", static_cast<int>(matches.size()));
  RecordProperty("right", right);
  RecordProperty("rms_hundredths", static_cast<int>(100 * std::sqrt(squares / right)));
  EXPECT_GT(right, 100);
  EXPECT_GT(right, 0.75 * static_cast<double>(matches.size()));
  EXPECT_LT(std::sqrt(squares / right), 1.3);
}

TEST(OrbExtractor, LowersItsThresholdInDimCells) {
  const TestTexture texture(7);
  Image image = texture.View(kWidth, kHeight, {0, 0});
  // The right half has a sixth of the contrast.
  for (int row = 0; row < kHeight; ++row) {
    for (int column = kWidth / 2; column < kWidth; ++column) {
      auto& pixel = image.data[static_cast<size_t>(row * kWidth + column)];
      pixel = static_cast<uint8_t>(10 + pixel / 6);
    }
  }
  const auto extractor = Extractor("orb");
  const FeatureSet features = Extracted(*extractor, image);
  int dim = 0;
  for (const auto& pixel : features.pixels) dim += pixel.x() > 360.0F ? 1 : 0;
  EXPECT_GT(dim, 50);
  EXPECT_EQ(extractor->status().rounds, 1);
  EXPECT_EQ(extractor->status().threshold_min, OrbOptions().fast_floor);
  EXPECT_EQ(extractor->status().threshold_max, OrbOptions().fast_threshold);
}

TEST(FeatureExtractor, RefusesUnknownNamesAndNetworksWithoutModel) {
  FeatureOptions options;
  options.frontend = "sift";
  EXPECT_THROW(FeatureExtractor::Create(options, std::nullopt), CheckError);
  options.frontend = "ghost";
  EXPECT_THROW(FeatureExtractor::Create(options, std::nullopt), InputError);
}

TEST(EvenSelection, FillsEmptyCellsFirst) {
  const KeypointGrid grid(160, 80, 80);
  EXPECT_EQ(grid.cells(), 2);
  const std::vector<Eigen::Vector2f> present = {{10, 10}, {20, 20}};
  const std::vector<Eigen::Vector2f> candidates = {{5, 5}, {6, 6}, {100, 5}, {110, 5}, {120, 5}};
  EvenSelection selection;
  std::vector<int> rows;
  selection.Select(grid, present, candidates, 3, &rows);
  EXPECT_EQ(rows, (std::vector<int>{0, 2, 3}));
  selection.Select(grid, present, candidates, 9, &rows);
  EXPECT_EQ(rows.size(), 5U);
}

}  // namespace
}  // namespace regolith
