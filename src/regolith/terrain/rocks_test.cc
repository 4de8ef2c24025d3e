// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/rocks.h"

#include <cmath>

#include <gtest/gtest.h>

namespace regolith {
namespace {

const Eigen::AlignedBox2d kBox(Eigen::Vector2d(-150, -150), Eigen::Vector2d(150, 150));

void ExpectLaw(const RockOptions& options) {
  const CraterField craters(CraterOptions{}, 3, kBox);
  const RockField field(options, 4, craters, kBox);
  const std::vector<Rock> rocks = field.Rocks(kBox, 0.1);
  for (const double diameter : {0.1, 0.2, 0.5}) {
    double count = 0.0;
    for (const Rock& rock : rocks) count += rock.diameter >= diameter ? 1.0 : 0.0;
    const double expected = kBox.volume() * (RockDensity(options, diameter) -
                                             RockDensity(options, options.max_diameter));
    // Five deviations of a Poisson count, and what the mean of the ejecta is uncertain by.
    EXPECT_NEAR(count, expected, 5.0 * std::sqrt(expected) + 0.02 * expected) << diameter;
  }
}

TEST(RockDensity, IsGolombeksTable) {
  RockOptions options;
  options.law = RockLaw::kGolombek;
  options.cover = 0.07;
  EXPECT_NEAR(RockDensity(options, 0.1), 1.4, 0.05);
  EXPECT_NEAR(RockDensity(options, 0.5), 0.027, 0.0006);
  options.cover = 0.18;
  EXPECT_NEAR(RockDensity(options, 0.2), 0.94, 0.01);
  EXPECT_NEAR(RockDensity(options, 1.0), 0.010, 0.001);
}

TEST(RockField, FollowsThePowerLawOfTheMoon) { ExpectLaw(RockOptions{}); }

TEST(RockField, FollowsGolombeksLawOfMars) {
  RockOptions options;
  options.law = RockLaw::kGolombek;
  ExpectLaw(options);
}

TEST(RockField, AgreesBetweenBoxesAndDiameters) {
  const CraterField craters(CraterOptions{}, 3, kBox);
  const RockField field(RockOptions{}, 4, craters, kBox);
  const Eigen::AlignedBox2d small(Eigen::Vector2d(-3, 2), Eigen::Vector2d(21, 17));
  std::vector<Rock> expected;
  for (const Rock& rock : field.Rocks(kBox, 0.05)) {
    if (small.contains(rock.centre) && rock.diameter >= 0.13) expected.push_back(rock);
  }
  const std::vector<Rock> rocks = field.Rocks(small, 0.13);
  ASSERT_EQ(rocks.size(), expected.size());
  ASSERT_GT(rocks.size(), 10U);
  for (size_t i = 0; i < rocks.size(); ++i) EXPECT_EQ(rocks[i].centre, expected[i].centre);
}

// The variance of counts in squares of 5 m over their mean: 1 where rocks do not know of each
// other.
double Dispersion(double clustering) {
  RockOptions options;
  options.clustering = clustering;
  const CraterField craters(CraterOptions{}, 3, kBox);
  const RockField field(options, 4, craters, kBox);
  std::vector<double> counts(3600, 0.0);
  double mean = 0.0;
  for (const Rock& rock : field.Rocks(kBox, 0.05)) {
    const Eigen::Vector2d square = (rock.centre - kBox.min()) / 5.0;
    counts[static_cast<size_t>(square.y()) * 60 + static_cast<size_t>(square.x())] += 1.0;
    mean += 1.0 / 3600.0;
  }
  double variance = 0.0;
  for (const double count : counts) variance += std::pow(count - mean, 2) / 3600.0;
  return variance / mean;
}

TEST(RockField, GathersRocksAroundFreshCraters) {
  EXPECT_NEAR(Dispersion(0.0), 1.0, 0.15);
  EXPECT_GT(Dispersion(0.8), 2.0);
}

}  // namespace
}  // namespace regolith
