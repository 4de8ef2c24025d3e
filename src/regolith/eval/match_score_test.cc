// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/match_score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "regolith/core/check.h"

namespace regolith {
namespace {

using testing::ElementsAre;
using Kind = TruePlace::Kind;

constexpr ImageSize kSize{20, 10};

/// Every pixel moves by (dx, dy); outside the second image there is no place.
struct Flow {
  std::vector<float> x;
  std::vector<float> y;
};
Flow ShiftedBy(float dx, float dy, ImageSize size = kSize) {
  Flow flow;
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const float x = static_cast<float>(column) + dx;
      const float y = static_cast<float>(row) + dy;
      const bool inside = x >= 0 && y >= 0 && x <= static_cast<float>(size.width - 1) &&
                          y <= static_cast<float>(size.height - 1);
      flow.x.push_back(inside ? x : NAN);
      flow.y.push_back(inside ? y : NAN);
    }
  }
  return flow;
}

void Put(Flow* flow, int column, int row, float x, float y) {
  const auto index = static_cast<size_t>(row * kSize.width + column);
  flow->x[index] = x;
  flow->y[index] = y;
}

PixelTruth TruthOf(const Flow& flow) {
  return PixelTruth::FromCorrespondences(flow.x, flow.y, kSize, kSize);
}

TEST(PixelTruth, HomographyTransfersBothWays) {
  Eigen::Matrix3d homography;
  homography << 2, 0, 1, 0, 2, -3, 0, 0, 1;
  // The sign is free.
  for (const double sign : {1.0, -1.0}) {
    const auto truth = PixelTruth::FromHomography(sign * homography, {20, 10}, {41, 21});
    const TruePlace place = truth.Find({3.5, 4.0});
    EXPECT_EQ(place.kind, Kind::kKnown);
    EXPECT_NEAR((place.pixel - Eigen::Vector2d(8, 5)).norm(), 0.0, 1e-12);
    EXPECT_TRUE(truth.IsSeenInFirst({8, 5}));
    EXPECT_TRUE(truth.IsSeenInFirst({1, 0}));
    EXPECT_FALSE(truth.IsSeenInFirst({-1, 5}));
    EXPECT_FALSE(truth.IsSeenInFirst({8, 16.5}));
  }
}

TEST(PixelTruth, NothingLiesBeyondTheHorizon) {
  Eigen::Matrix3d homography = Eigen::Matrix3d::Identity();
  homography(2, 0) = -1.0 / 15.0;  // the horizon is the column 15
  const auto truth = PixelTruth::FromHomography(homography, kSize, kSize);
  EXPECT_EQ(truth.Find({12, 3}).kind, Kind::kKnown);
  EXPECT_EQ(truth.Find({15, 3}).kind, Kind::kAbsent);
  EXPECT_EQ(truth.Find({18, 3}).kind, Kind::kAbsent);
}

TEST(PixelTruth, CorrespondencesAreInterpolated) {
  const PixelTruth truth = TruthOf(ShiftedBy(2.25F, -1.0F));
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(4, 5), Eigen::Vector2d(4.3, 5.8)}) {
    const TruePlace place = truth.Find(pixel);
    ASSERT_EQ(place.kind, Kind::kKnown);
    EXPECT_NEAR((place.pixel - pixel - Eigen::Vector2d(2.25, -1.0)).norm(), 0.0, 1e-6);
  }
  // A pixel exactly on the grid asks no neighbour: column 16 lands at 18.25, column 17 nowhere.
  EXPECT_EQ(truth.Find({16, 5}).kind, Kind::kKnown);
  EXPECT_EQ(truth.Find({16.5, 5}).kind, Kind::kUnknown);
  EXPECT_EQ(truth.Find({17.5, 5}).kind, Kind::kAbsent);
  // Beyond the outermost centres the border counts.
  EXPECT_EQ(truth.Find({-0.4, 5}).kind, Kind::kKnown);
  EXPECT_EQ(truth.Find({19.4, 9.4}).kind, Kind::kAbsent);
}

TEST(PixelTruth, NobodyKnowsTheSideOfAnEdge) {
  Flow flow = ShiftedBy(0, 0);
  for (int row = 0; row < kSize.height; ++row) {
    Put(&flow, 10, row, 15.0F, static_cast<float>(row));
  }
  const PixelTruth truth = TruthOf(flow);
  EXPECT_EQ(truth.Find({9.5, 4}).kind, Kind::kUnknown);
  EXPECT_EQ(truth.Find({10, 4}).kind, Kind::kKnown);
  EXPECT_THAT(truth.PossiblePlaces({9.5, 4}),
              ElementsAre(Eigen::Vector2d(9, 4), Eigen::Vector2d(15, 4)));
}

TEST(PixelTruth, SeenIsWhatThePixelsOfTheFirstLandOn) {
  const PixelTruth truth = TruthOf(ShiftedBy(5, 0));
  EXPECT_FALSE(truth.IsSeenInFirst({3, 5}));
  EXPECT_TRUE(truth.IsSeenInFirst({5, 5}));
  EXPECT_TRUE(truth.IsSeenInFirst({19.3, 5}));
  EXPECT_FALSE(truth.IsSeenInFirst({21, 5}));
  EXPECT_FALSE(truth.IsSeenInFirst({5, -2}));
}

// From twice as near, pixels land two apart; what lies between is seen all the same.
TEST(PixelTruth, AMagnifiedSurfaceHasNoHoles) {
  for (const float offset : {0.0F, 0.5F}) {
    Flow flow;
    for (int row = 0; row < 10; ++row) {
      for (int column = 0; column < 20; ++column) {
        flow.x.push_back(2.0F * static_cast<float>(column) + offset);
        flow.y.push_back(2.0F * static_cast<float>(row) + offset);
      }
    }
    const auto truth = PixelTruth::FromCorrespondences(flow.x, flow.y, kSize, {40, 20});
    for (int row = 0; row < 20; ++row) {
      for (int column = 0; column < 40; ++column) {
        EXPECT_TRUE(truth.IsSeenInFirst(Eigen::Vector2d(column, row))) << column << " " << row;
      }
    }
  }
}

TEST(PixelTruth, SizesMustFit) {
  EXPECT_THROW(PixelTruth::FromCorrespondences({1, 2}, {1, 2}, kSize, kSize), CheckError);
  EXPECT_THROW(PixelTruth::FromHomography(Eigen::Matrix3d::Zero(), kSize, kSize), CheckError);
}

TEST(MatchScore, CountsCorrectWrongAndUnknown) {
  Flow flow = ShiftedBy(1, 0);
  Put(&flow, 5, 5, NAN, NAN);
  const std::vector<ScoredMatch> matches = {{{2, 2}, {3, 2}, true},      // exact
                                            {{2, 2}, {3, 4.5}, true},    // 2.5 pixels off
                                            {{2, 2}, {7, 2}, false},     // 4 off
                                            {{5, 5}, {6, 5}, true},      // occluded
                                            {{4.5, 5}, {5.5, 5}, true},  // at the occlusion's edge
                                            {{19, 5}, {19, 5}, false},   // left the image
                                            {{3, 3}, {4.0, 6.0}, false}};  // exactly the tolerance
  const MatchScore score = ScoreMatches(matches, TruthOf(flow), 3.0);
  using V = MatchVerdict;
  EXPECT_THAT(score.verdicts, ElementsAre(V::kCorrect, V::kCorrect, V::kWrong, V::kWrong,
                                          V::kUnknown, V::kWrong, V::kCorrect));
  EXPECT_NEAR(score.errors[1], 2.5, 1e-6);
  EXPECT_NEAR(score.errors[2], 4.0, 1e-6);
  EXPECT_TRUE(std::isnan(score.errors[3]));
  EXPECT_TRUE(std::isnan(score.errors[4]));
  EXPECT_EQ(score.all.matches, 7);
  EXPECT_EQ(score.all.known, 6);
  EXPECT_EQ(score.all.correct, 3);
  EXPECT_EQ(score.inliers.matches, 4);
  EXPECT_EQ(score.inliers.known, 3);
  EXPECT_EQ(score.inliers.correct, 2);
  EXPECT_NEAR(*score.all.Precision(), 0.5, 1e-12);
  EXPECT_NEAR(*score.inliers.Precision(), 2.0 / 3.0, 1e-12);
}

TEST(MatchScore, NothingHasNoPrecision) {
  const MatchScore score = ScoreMatches({}, TruthOf(ShiftedBy(0, 0)), 3.0);
  EXPECT_FALSE(score.all.Precision().has_value());
  EXPECT_EQ(score.all.matches, 0);
}

TEST(MatchScore, RepeatabilityCountsBothImages) {
  const PixelTruth truth = TruthOf(ShiftedBy(2, 0));
  // Of the first: two are shown in the second (the third leaves it), one has a partner.
  const std::vector<Eigen::Vector2d> first = {{3, 3}, {8, 8}, {19, 5}};
  // Of the second: the first two are shown in the first, one of them has a partner.
  const std::vector<Eigen::Vector2d> second = {{5, 3.8}, {15, 2}, {0, 0}};
  EXPECT_NEAR(*Repeatability(first, second, truth, 1.0), 2.0 / 4.0, 1e-12);
  EXPECT_NEAR(*Repeatability(first, second, truth, 0.5), 0.0, 1e-12);
  EXPECT_NEAR(*Repeatability(first, second, truth, 20.0), 1.0, 1e-12);
  EXPECT_FALSE(Repeatability({}, {}, truth, 1.0).has_value());
  EXPECT_NEAR(*Repeatability(first, {}, truth, 1.0), 0.0, 1e-12);
}

TEST(MatchScore, RepeatabilityOfAHomographyIsThatOfItsInverse) {
  Eigen::Matrix3d homography;
  homography << 1, 0, 3, 0, 1, 1, 0, 0, 1;
  const std::vector<Eigen::Vector2d> first = {{2, 2}, {6, 6}, {15, 5}, {18, 3}};
  const std::vector<Eigen::Vector2d> second = {{5, 3}, {9, 8.5}, {18.5, 6}, {1, 1}};
  for (const double radius : {1.0, 2.0}) {
    const auto there =
        Repeatability(first, second, PixelTruth::FromHomography(homography, kSize, kSize), radius);
    const auto back = Repeatability(
        second, first, PixelTruth::FromHomography(homography.inverse(), kSize, kSize), radius);
    ASSERT_TRUE(there && back);
    EXPECT_NEAR(*there, *back, 1e-12);
  }
}

}  // namespace
}  // namespace regolith
