// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/epipolar_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"
#include "regolith/features/feature_extractor.h"
#include "regolith/stereo/test_stereo_world_internal.h"

namespace regolith {
namespace {

/// Random spots, seen shifted to the left by `shift` pixels.
Image Spots(double shift) {
  std::vector<float> grey(640 * 480, 110.0F);
  Random random(5);
  for (int i = 0; i < 2500; ++i) {
    const Eigen::Vector2d centre(random.Uniform(0, 700) - shift, random.Uniform(0, 480));
    const double radius = random.Uniform(1.5, 6.0);
    const double height = random.Uniform(-60, 60);
    const int reach = static_cast<int>(3.0 * radius);
    for (int y = std::max(0, static_cast<int>(centre.y()) - reach);
         y < std::min(480, static_cast<int>(centre.y()) + reach); ++y) {
      for (int x = std::max(0, static_cast<int>(centre.x()) - reach);
           x < std::min(640, static_cast<int>(centre.x()) + reach); ++x) {
        const double square = (Eigen::Vector2d(x, y) - centre).squaredNorm() / (radius * radius);
        grey[static_cast<size_t>(y * 640 + x)] +=
            static_cast<float>(height / (1.0 + square * square * square));
      }
    }
  }
  Image image{640, 480, std::vector<uint8_t>(640 * 480)};
  for (size_t i = 0; i < grey.size(); ++i) {
    image.data[i] = static_cast<uint8_t>(std::clamp(std::lround(grey[i]), 0L, 255L));
  }
  return image;
}

FeatureSet Extracted(const Image& image) {
  FeatureOptions options;
  options.frontend = "orb";
  FeatureSet features;
  FeatureExtractor::Create(options, std::nullopt)->Extract(image, nullptr, 600, &features);
  return features;
}

TEST(EpipolarMatcher, FindsDisparitiesToAFractionOfAPixel) {
  for (const double shift : {12.0, 12.4, 25.7}) {
    const Image left = Spots(0.0);
    const Image right = Spots(shift);
    const FeatureSet left_set = Extracted(left);
    EpipolarMatcher matcher(EpipolarMatcherOptions(), kTestCamera);
    const StereoFeatures features = matcher.Match(left, right, left_set, Extracted(right));
    std::vector<double> errors;
    for (size_t i = 0; i < features.size(); ++i) {
      if (!features.HasRight(i)) continue;
      errors.push_back(std::abs(features.pixels[i].x() - features.right_columns[i] - shift));
    }
    ASSERT_GT(errors.size(), left_set.size() / 3);
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.12) << shift;
    EXPECT_LT(errors[errors.size() * 9 / 10], 0.5) << shift;
  }
}

TEST(EpipolarMatcher, ExchangedImagesFitTheOtherWayRound) {
  const Image left = Spots(20.0);
  const Image right = Spots(0.0);
  const FeatureSet left_set = Extracted(left);
  const FeatureSet right_set = Extracted(right);
  EpipolarMatcher matcher(EpipolarMatcherOptions(), kTestCamera);
  const StereoFeatures features = matcher.Match(left, right, left_set, right_set);
  int found = 0;
  for (size_t i = 0; i < features.size(); ++i) found += features.HasRight(i) ? 1 : 0;
  EXPECT_LT(found, 20);
  EXPECT_GT(matcher.CountReversed(left_set, right_set), 150);
}

TEST(EpipolarMatcher, ABlackEyeGivesNothing) {
  const Image left = Spots(0.0);
  const Image black{640, 480, std::vector<uint8_t>(640 * 480, 3)};
  EpipolarMatcher matcher(EpipolarMatcherOptions(), kTestCamera);
  const StereoFeatures features = matcher.Match(left, black, Extracted(left), Extracted(black));
  for (size_t i = 0; i < features.size(); ++i) EXPECT_FALSE(features.HasRight(i));
}

}  // namespace
}  // namespace regolith
