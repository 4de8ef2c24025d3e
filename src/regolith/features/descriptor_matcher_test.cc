// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/descriptor_matcher.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

/// Unit vectors of multiples of 2^-14, whose inner products are exact in double precision.
Descriptors RandomFloats(size_t size, int dimension, uint64_t seed) {
  Random random(seed);
  Descriptors result;
  result.type = DescriptorType::kFloat;
  result.dimension = dimension;
  for (size_t i = 0; i < size; ++i) {
    Eigen::VectorXd row(dimension);
    for (double& value : row) value = random.Gaussian();
    row.normalize();
    for (const double value : row) {
      result.values.push_back(static_cast<float>(std::round(value * 16384.0) / 16384.0));
    }
  }
  return result;
}

Descriptors RandomBits(size_t size, uint64_t seed) {
  Random random(seed);
  Descriptors result;
  result.type = DescriptorType::kBinary;
  for (size_t i = 0; i < size * kBinaryBytes; ++i) {
    result.bits.push_back(static_cast<uint8_t>(random.Next() >> 56));
  }
  return result;
}

/// Rows of `from`, drawn with repetition, each changed a little or not at all.
Descriptors Resembling(const Descriptors& from, size_t size, uint64_t seed) {
  Random random(seed);
  Descriptors result;
  result.ResetLike(from);
  const auto dimension = static_cast<size_t>(from.dimension);
  for (size_t i = 0; i < size; ++i) {
    result.Append(from, static_cast<size_t>(random.Next() % from.size()));
    const auto changes = static_cast<size_t>(random.Next() % 3);
    for (size_t change = 0; change < changes; ++change) {
      if (from.type == DescriptorType::kFloat) {
        // Two components change places, so the length stays.
        float* row = result.values.data() + i * dimension;
        std::swap(row[random.Next() % dimension], row[random.Next() % dimension]);
      } else {
        result.bits[i * kBinaryBytes + random.Next() % kBinaryBytes] ^= 0x11;
      }
    }
  }
  return result;
}

double SimilarityBetween(const Descriptors& first, size_t row, const Descriptors& second,
                         size_t column) {
  if (first.type == DescriptorType::kBinary) {
    int distance = 0;
    for (size_t i = 0; i < kBinaryBytes; ++i) {
      distance +=
          __builtin_popcount(static_cast<unsigned>(first.Bits(row)[i] ^ second.Bits(column)[i]));
    }
    return 1.0 - distance / 256.0;
  }
  double similarity = 0.0;
  for (int i = 0; i < first.dimension; ++i) {
    similarity += static_cast<double>(first.Row(row)[i]) * second.Row(column)[i];
  }
  return similarity;
}

double Distance(DescriptorType type, double similarity) {
  if (type == DescriptorType::kBinary) return 256.0 * (1.0 - similarity);
  return std::sqrt(std::max(0.0, 2.0 - 2.0 * similarity));
}

/// The definition, pair by pair; `allowed` may leave pairs out.
template <typename Allowed>
std::vector<FeatureMatch> NaiveMatches(const Descriptors& first, const Descriptors& second,
                                       const DescriptorMatcherOptions& options,
                                       const Allowed& allowed) {
  const auto nearest = [&](size_t index, bool of_first, double* similarity) {
    double runner_up = -INFINITY;
    int result = -1;
    *similarity = -INFINITY;
    const size_t others = of_first ? second.size() : first.size();
    for (size_t other = 0; other < others; ++other) {
      const size_t row = of_first ? index : other;
      const size_t column = of_first ? other : index;
      if (!allowed(row, column)) continue;
      const double value = SimilarityBetween(first, row, second, column);
      if (value > *similarity) {
        runner_up = *similarity;
        *similarity = value;
        result = static_cast<int>(other);
      } else {
        runner_up = std::max(runner_up, value);
      }
    }
    const bool tie = *similarity == runner_up && options.ratio < 1.0;
    const bool clear =
        Distance(first.type, *similarity) <= options.ratio * Distance(first.type, runner_up);
    return clear && !tie ? result : -1;
  };
  std::vector<FeatureMatch> matches;
  for (size_t row = 0; row < first.size(); ++row) {
    double similarity = 0.0;
    double back_similarity = 0.0;
    const int column = nearest(row, true, &similarity);
    if (column < 0) continue;
    const bool binary = first.type == DescriptorType::kBinary;
    if (!binary && similarity < options.min_similarity) continue;
    if (binary && (1.0 - similarity) * 256.0 > options.max_hamming) continue;
    if (options.mutual &&
        nearest(static_cast<size_t>(column), false, &back_similarity) != static_cast<int>(row)) {
      continue;
    }
    matches.push_back({static_cast<int>(row), column, static_cast<float>(similarity)});
  }
  return matches;
}

void ExpectEqual(const std::vector<FeatureMatch>& matches,
                 const std::vector<FeatureMatch>& expected) {
  ASSERT_EQ(matches.size(), expected.size());
  for (size_t i = 0; i < matches.size(); ++i) {
    EXPECT_EQ(matches[i].first, expected[i].first);
    EXPECT_EQ(matches[i].second, expected[i].second);
    EXPECT_FLOAT_EQ(matches[i].score, expected[i].score);
  }
}

constexpr auto kAll = [](size_t, size_t) { return true; };

/// Both ways through all sizes, with options that make each rule count.
void CompareWithDefinition(const Descriptors& all, bool guided) {
  size_t found = 0;
  for (const size_t first_size : {0U, 1U, 7U, 500U}) {
    for (const size_t second_size : {0U, 1U, 7U, 493U}) {
      const Descriptors first = Resembling(all, first_size, 17 + first_size);
      const Descriptors second = Resembling(all, second_size, 29 + second_size);
      Random random(first_size + second_size);
      std::vector<Eigen::Vector2f> pixels;
      MatchGuide guide;
      const auto pixel = [&] {
        // Whole numbers, so that some lie on the very edge of a radius.
        return Eigen::Vector2f(std::floor(random.Uniform(0, 300)),
                               std::floor(random.Uniform(-20, 200)));
      };
      for (size_t i = 0; i < second_size; ++i) pixels.push_back(pixel());
      for (size_t i = 0; i < first_size; ++i) {
        guide.predicted.push_back(pixel());
        guide.radii.push_back(static_cast<float>(std::floor(random.Uniform(-2, 60))));
      }
      const auto within = [&](size_t row, size_t column) {
        return guide.radii[row] >= 0.0F &&
               (pixels[column] - guide.predicted[row]).norm() <= guide.radii[row];
      };
      for (const bool mutual : {false, true}) {
        for (const double ratio : {0.8, 1.0}) {
          DescriptorMatcherOptions options;
          options.mutual = mutual;
          options.ratio = ratio;
          options.min_similarity = 0.3;
          options.max_hamming = 110;
          DescriptorMatcher matcher(options);
          std::vector<FeatureMatch> matches = {{1, 2, 3.0F}};
          if (guided) {
            matcher.MatchGuided(first, second, guide, pixels, &matches);
            ExpectEqual(matches, NaiveMatches(first, second, options, within));
          } else {
            matcher.Match(first, second, &matches);
            ExpectEqual(matches, NaiveMatches(first, second, options, kAll));
          }
          found += matches.size();
        }
      }
    }
  }
  EXPECT_GT(found, 200U);
}

TEST(DescriptorMatcher, FloatMatchesFollowTheDefinition) {
  for (const int dimension : {64, 128, 250, 256}) {
    CompareWithDefinition(RandomFloats(300, dimension, 5), false);
  }
}

TEST(DescriptorMatcher, BinaryMatchesFollowTheDefinition) {
  CompareWithDefinition(RandomBits(300, 5), false);
}

TEST(DescriptorMatcher, GuidedMatchesFollowTheDefinition) {
  CompareWithDefinition(RandomFloats(40, 64, 6), true);
  CompareWithDefinition(RandomFloats(40, 256, 6), true);
  CompareWithDefinition(RandomBits(40, 6), true);
}

TEST(DescriptorMatcher, AGuideWithoutBoundsIsNoGuide) {
  const Descriptors first = RandomFloats(60, 64, 1);
  const Descriptors second = Resembling(first, 50, 2);
  MatchGuide guide;
  guide.predicted.assign(60, Eigen::Vector2f(3.0F, 4.0F));
  guide.radii.assign(60, std::numeric_limits<float>::infinity());
  std::vector<Eigen::Vector2f> pixels(50, Eigen::Vector2f(1e6F, -1e6F));
  DescriptorMatcher matcher({});
  std::vector<FeatureMatch> guided;
  std::vector<FeatureMatch> matches;
  matcher.MatchGuided(first, second, guide, pixels, &guided);
  matcher.Match(first, second, &matches);
  EXPECT_GT(matches.size(), 10U);
  ExpectEqual(guided, matches);

  guide.predicted.assign(60, Eigen::Vector2f(NAN, 0.0F));
  matcher.MatchGuided(first, second, guide, pixels, &guided);
  EXPECT_TRUE(guided.empty());
  guide.predicted.assign(60, Eigen::Vector2f::Zero());
  pixels.assign(50, Eigen::Vector2f(NAN, 0.0F));
  matcher.MatchGuided(first, second, guide, pixels, &guided);
  EXPECT_TRUE(guided.empty());
}

TEST(DescriptorMatcher, TiesGoToTheLowerRowAndAreAmbiguous) {
  Descriptors first = RandomFloats(1, 64, 3);
  Descriptors second;
  second.ResetLike(first);
  second.Append(RandomFloats(1, 64, 4), 0);
  for (int i = 0; i < 20; ++i) second.Append(first, 0);
  DescriptorMatcherOptions options;
  options.ratio = 1.0;
  std::vector<FeatureMatch> matches;
  DescriptorMatcher(options).Match(first, second, &matches);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].second, 1);
  options.ratio = 0.99;
  DescriptorMatcher(options).Match(first, second, &matches);
  EXPECT_TRUE(matches.empty());
}

TEST(DescriptorMatcher, SwappedSetsGiveTheSamePairs) {
  const Descriptors first = RandomFloats(200, 64, 1);
  const Descriptors second = Resembling(first, 150, 2);
  DescriptorMatcher matcher({});
  std::vector<FeatureMatch> forward;
  std::vector<FeatureMatch> back;
  matcher.Match(first, second, &forward);
  matcher.Match(second, first, &back);
  for (FeatureMatch& match : back) std::swap(match.first, match.second);
  std::sort(back.begin(), back.end(), [](auto& a, auto& b) { return a.first < b.first; });
  EXPECT_GT(forward.size(), 30U);
  ExpectEqual(back, forward);
}

TEST(DescriptorMatcher, BuffersKeptDoNotChangeResults) {
  const Descriptors large = RandomFloats(100, 256, 1);
  const Descriptors small = RandomFloats(9, 64, 2);
  const Descriptors like_small = Resembling(small, 11, 3);
  DescriptorMatcher used({});
  std::vector<FeatureMatch> matches;
  used.Match(large, large, &matches);
  EXPECT_EQ(matches.size(), 100U);
  used.Match(small, like_small, &matches);
  std::vector<FeatureMatch> fresh;
  DescriptorMatcher({}).Match(small, like_small, &fresh);
  ExpectEqual(matches, fresh);
}

TEST(DescriptorMatcher, RefusesSetsThatCannotBeCompared) {
  DescriptorMatcher matcher({});
  std::vector<FeatureMatch> matches;
  EXPECT_THROW(matcher.Match(RandomFloats(2, 64, 1), RandomFloats(2, 128, 1), &matches),
               CheckError);
  EXPECT_THROW(matcher.Match(RandomFloats(2, 64, 1), RandomBits(2, 1), &matches), CheckError);
  EXPECT_THROW(matcher.MatchGuided(RandomBits(2, 1), RandomBits(2, 1), {}, {}, &matches),
               CheckError);
  Descriptors broken = RandomFloats(2, 64, 1);
  for (float& value : broken.values) value *= 2.0F;
  EXPECT_THROW(matcher.Match(broken, broken, &matches), CheckError);
  broken.values.assign(128, NAN);
  EXPECT_THROW(matcher.Match(broken, broken, &matches), CheckError);
  matcher.Match(Descriptors{}, RandomBits(2, 1), &matches);
  EXPECT_TRUE(matches.empty());
}

}  // namespace
}  // namespace regolith
