// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/view_warp.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "regolith/core/random.h"
#include "regolith/features/test_texture_internal.h"

namespace regolith {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

Eigen::Vector2d Transform(const Eigen::Matrix3d& homography, const Eigen::Vector2d& place) {
  return (homography * place.homogeneous()).hnormalized();
}

/// Ground that the way ahead stretches, and that leaves the picture below: its horizon is a line
/// at row 600.
Eigen::Matrix3d WayAhead() {
  Eigen::Matrix3d homography;
  homography << 0.9, -0.12, 20.0, 0.03, 1.0, -60.0, 0.0, -1.0 / 600.0, 1.0;
  return homography;
}

struct Matches {
  std::vector<Eigen::Vector2f> first;
  std::vector<Eigen::Vector2f> second;
  std::vector<uint8_t> inliers;
};

/// Places that follow the homography to half a pixel; of the last `wrong` any.
Matches Follow(const Eigen::Matrix3d& homography, int right, int wrong) {
  Random random(3);
  Matches matches;
  for (int i = 0; i < right + wrong; ++i) {
    const Eigen::Vector2d place(random.Uniform(0.0, kWidth), random.Uniform(0.0, 400.0));
    Eigen::Vector2d moved = Transform(homography, place);
    moved += Eigen::Vector2d(random.Gaussian(0.0, 0.5), random.Gaussian(0.0, 0.5));
    if (i >= right) moved = {random.Uniform(0.0, kWidth), random.Uniform(0.0, kHeight)};
    matches.first.push_back(place.cast<float>());
    matches.second.push_back(moved.cast<float>());
    matches.inliers.push_back(1);
  }
  return matches;
}

TEST(PlaneHomography, IsFoundAmongWrongMatches) {
  const Matches matches = Follow(WayAhead(), 120, 40);
  const auto found = PlaneHomography(matches.first, matches.second, matches.inliers);
  ASSERT_TRUE(found);
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(30.0, 20.0), Eigen::Vector2d(600.0, 100.0),
                                       Eigen::Vector2d(320.0, 390.0)}) {
    EXPECT_LT((Transform(*found, place) - Transform(WayAhead(), place)).norm(), 3.0);
  }
  // Positive this side of its horizon, 1 in the mean of the places.
  double depth = 0.0;
  for (int i = 0; i < 120; ++i) {
    depth += found->row(2).dot(matches.first[static_cast<size_t>(i)].cast<double>().homogeneous());
  }
  EXPECT_NEAR(depth / 120.0, 1.0, 0.1);
}

TEST(PlaneHomography, AsksInliersAlone) {
  Matches matches = Follow(WayAhead(), 60, 200);
  for (size_t i = 60; i < matches.inliers.size(); ++i) matches.inliers[i] = 0;
  const auto found = PlaneHomography(matches.first, matches.second, matches.inliers);
  ASSERT_TRUE(found);
  const Eigen::Vector2d place(320.0, 240.0);
  EXPECT_LT((Transform(*found, place) - Transform(WayAhead(), place)).norm(), 3.0);
}

TEST(PlaneHomography, NeedsTenThatAgreeAndNoMirror) {
  const auto of = [](const Matches& matches) {
    return PlaneHomography(matches.first, matches.second, matches.inliers);
  };
  EXPECT_FALSE(of({}));
  EXPECT_FALSE(of(Follow(WayAhead(), 9, 0)));
  EXPECT_TRUE(of(Follow(WayAhead(), 12, 0)));
  EXPECT_FALSE(of(Follow(WayAhead() * Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal(), 60, 0)));
  // All in one place.
  Matches same = Follow(WayAhead(), 20, 0);
  same.first.assign(20, {100.0F, 100.0F});
  same.second.assign(20, {120.0F, 90.0F});
  EXPECT_FALSE(of(same));
}

TEST(MedianEnlargement, IsThatOfAreas) {
  const Eigen::Matrix3d twice = Eigen::Vector3d(2.0, 1.5, 1.0).asDiagonal();
  EXPECT_NEAR(MedianEnlargement(twice, {{10.0F, 20.0F}, {300.0F, 5.0F}}), 3.0, 1e-12);
  EXPECT_EQ(MedianEnlargement(WayAhead(), {{0.0F, 650.0F}}), 1.0);
  EXPECT_EQ(MedianEnlargement(twice, {}), 1.0);
  // By differences.
  const Eigen::Vector2d place(200.0, 300.0);
  const auto moved = [&](double x, double y) {
    return Transform(WayAhead(), place + Eigen::Vector2d(x, y));
  };
  Eigen::Matrix2d derivative;
  derivative << (moved(0.01, 0.0) - moved(-0.01, 0.0)) / 0.02,
      (moved(0.0, 0.01) - moved(0.0, -0.01)) / 0.02;
  EXPECT_NEAR(MedianEnlargement(WayAhead(), {place.cast<float>()}), derivative.determinant(), 1e-4);
}

TEST(WarpImage, ShowsWhatTheOtherViewSees) {
  const Image image = TestTexture(5).View(kWidth, kHeight, Eigen::Vector2d::Zero());
  const WarpedView view = WarpImage(image, WayAhead(), 500, 400, 4);
  ASSERT_EQ(view.image.width, 500);
  ASSERT_EQ(view.mask.height, 400);
  const Eigen::Matrix3d back = WayAhead().inverse();
  int compared = 0;
  int hidden = 0;
  for (int row = 0; row < 400; row += 7) {
    for (int column = 0; column < 500; column += 7) {
      const Eigen::Vector2d place = Transform(back, Eigen::Vector2d(column, row));
      const int x = static_cast<int>(std::lround(place.x()));
      const int y = static_cast<int>(std::lround(place.y()));
      const bool inside = x >= 4 && y >= 4 && x < kWidth - 4 && y < kHeight - 4;
      EXPECT_EQ(view.mask.At(column, row) != 0, inside) << column << ", " << row;
      if (!inside) {
        ++hidden;
        continue;
      }
      const double u = place.x() - std::floor(place.x());
      const double v = place.y() - std::floor(place.y());
      const int left = static_cast<int>(place.x());
      const int top = static_cast<int>(place.y());
      const double expected =
          (1 - v) * ((1 - u) * image.At(left, top) + u * image.At(left + 1, top)) +
          v * ((1 - u) * image.At(left, top + 1) + u * image.At(left + 1, top + 1));
      EXPECT_NEAR(view.image.At(column, row), expected, 4.0);  // OpenCV counts in 32nds of a pixel
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(hidden, 40);
}

TEST(WarpImage, OfAnImageWithinItsBorderHasNothingToFind) {
  const WarpedView view = WarpImage(FlatImage(8, 8, 90), Eigen::Matrix3d::Identity(), 20, 20, 4);
  EXPECT_EQ(std::count(view.mask.data.begin(), view.mask.data.end(), uint8_t{0}), 400);
  EXPECT_EQ(view.image.At(19, 19), 90);
}

}  // namespace
}  // namespace regolith
