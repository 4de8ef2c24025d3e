// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/optical_flow.h"

#include <cmath>
#include <functional>
#include <utility>

#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>

#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

/// Random values on a lattice of `step` pixels with smooth transitions, in [-1, 1].
double LatticeNoise(double x, double y, double step) {
  const double column = std::floor(x / step);
  const double row = std::floor(y / step);
  const auto value = [&](int right, int down) {
    return HashUniform(7, static_cast<uint64_t>(column + right + 1000.0),
                       static_cast<uint64_t>(row + down + 1000.0), static_cast<uint64_t>(step));
  };
  const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double u = ease(x / step - column);
  const double v = ease(y / step - row);
  const double top = (1.0 - u) * value(0, 0) + u * value(1, 0);
  const double bottom = (1.0 - u) * value(0, 1) + u * value(1, 1);
  return 2.0 * ((1.0 - v) * top + v * bottom) - 1.0;
}

/// Grey at a place of the scene: nothing in it repeats.
double Texture(double x, double y) {
  return 128.0 + 60.0 * LatticeNoise(x, y, 32.0) + 35.0 * LatticeNoise(x, y, 13.0) +
         20.0 * LatticeNoise(x, y, 7.0);
}

Image Render(const std::function<double(double, double)>& grey, int width = kWidth,
             int height = kHeight) {
  Image image;
  image.width = width;
  image.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.data.push_back(static_cast<uint8_t>(std::lround(grey(x, y))));
    }
  }
  return image;
}

/// The texture moved by (dx, dy) pixels.
Image Moved(double dx, double dy) {
  return Render([=](double x, double y) { return Texture(x - dx, y - dy); });
}

std::vector<Eigen::Vector2f> Grid(float margin) {
  std::vector<Eigen::Vector2f> points;
  for (float y = margin; y < kHeight - margin; y += 17.3F) {
    for (float x = margin; x < kWidth - margin; x += 19.7F) points.emplace_back(x, y);
  }
  return points;
}

int Count(const FlowResult& result) {
  int count = 0;
  for (const uint8_t found : result.found) count += found;
  return count;
}

FlowResult TrackBetween(const Image& first, const Image& second,
                        const std::vector<Eigen::Vector2f>& points,
                        const std::vector<Eigen::Vector2f>& guess = {}) {
  OpticalFlow flow({});
  flow.Advance(first);
  flow.Advance(second);
  FlowResult result;
  flow.Track(points, guess, &result);
  EXPECT_EQ(result.pixels.size(), points.size());
  EXPECT_EQ(result.found.size(), points.size());
  EXPECT_EQ(result.errors.size(), points.size());
  return result;
}

TEST(OpticalFlow, FollowsAMovedTextureToATwentiethOfAPixel) {
  const std::vector<Eigen::Vector2f> points = Grid(30.0F);
  const Eigen::Vector2f motion(5.3F, -3.7F);
  const FlowResult result = TrackBetween(Moved(0.0, 0.0), Moved(5.3, -3.7), points);
  EXPECT_EQ(Count(result), static_cast<int>(points.size()));
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((result.pixels[i] - points[i] - motion).norm(), 0.05F) << points[i].transpose();
    EXPECT_LT(result.errors[i], 1.0F);  // rounding to whole grey levels
  }
}

/// One bright spot at (centre, 120) and nothing else.
Image Spot(double centre, double background) {
  return Render([=](double x, double y) {
    const double square = (x - centre) * (x - centre) + (y - 120.0) * (y - 120.0);
    return background + 200.0 * std::exp(-square / 32.0);
  });
}

TEST(OpticalFlow, ErrorsAreMeanGreyDifferences) {
  // A symmetric spot that only becomes brighter does not seem to move.
  const FlowResult result = TrackBetween(Spot(50.0, 20.0), Spot(50.0, 26.0), {{50.0F, 120.0F}});
  ASSERT_EQ(Count(result), 1);
  EXPECT_NEAR(result.errors[0], 6.0F, 0.01F);
}

TEST(OpticalFlow, StepsFromImageToImage) {
  OpticalFlow flow({});
  std::vector<Eigen::Vector2f> points = Grid(40.0F);
  const std::vector<Eigen::Vector2f> start = points;
  FlowResult result;
  flow.Advance(Moved(0.0, 0.0));
  for (int step = 1; step <= 4; ++step) {
    flow.Advance(Moved(3.0 * step, 1.5 * step));
    flow.Track(points, {}, &result);
    points = result.pixels;
  }
  ASSERT_EQ(Count(result), static_cast<int>(points.size()));
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((points[i] - start[i] - Eigen::Vector2f(12.0F, 6.0F)).norm(), 0.2F);
  }
  // Moving the tracker takes its images along; forgetting them leaves nothing to track from.
  OpticalFlow other = std::move(flow);
  other.Reset();
  other.Advance(Moved(0.0, 0.0));
  other.Track(points, {}, &result);
  EXPECT_EQ(Count(result), 0);
}

TEST(OpticalFlow, AGuessReachesWhereThePyramidDoesNot) {
  // The spot is further away than the coarsest patch sees.
  const std::vector<Eigen::Vector2f> points = {{50.0F, 120.0F}};
  EXPECT_EQ(Count(TrackBetween(Spot(50.0, 20.0), Spot(270.0, 20.0), points)), 0);
  const FlowResult result =
      TrackBetween(Spot(50.0, 20.0), Spot(270.0, 20.0), points, {{267.0F, 122.0F}});
  ASSERT_EQ(Count(result), 1);
  EXPECT_NEAR(result.pixels[0].x(), 270.0F, 0.05F);
  EXPECT_NEAR(result.pixels[0].y(), 120.0F, 0.05F);
  // A guess that is no place in the image is none.
  EXPECT_EQ(Count(TrackBetween(Spot(50.0, 20.0), Spot(52.0, 20.0), points, {{NAN, -1e30F}})), 1);
}

TEST(OpticalFlow, LosesWhatLeavesTheImageOrWasNeverInIt) {
  const FlowResult result = TrackBetween(
      Moved(0.0, 0.0), Moved(-12.0, 0.0),
      {{5.0F, 100.0F}, {-3.0F, 50.0F}, {400.0F, 50.0F}, {NAN, 3.0F}, {100.0F, 100.0F}});
  EXPECT_EQ(result.found, (std::vector<uint8_t>{0, 0, 0, 0, 1}));
}

TEST(OpticalFlow, TheWayBackExposesWhatWasCovered) {
  // A flat board covers the left half in the second image: nothing there can be followed.
  const Image covered =
      Render([](double x, double y) { return x < 160.0 ? 128.0 : Texture(x, y); });
  const std::vector<Eigen::Vector2f> points = Grid(30.0F);
  const FlowResult result = TrackBetween(Moved(0.0, 0.0), covered, points);
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].x() > 130.0F && points[i].x() < 190.0F) continue;
    EXPECT_EQ(result.found[i], points[i].x() > 160.0F) << points[i].transpose();
  }
}

TEST(OpticalFlow, FindsNothingInImagesThatShowNothing) {
  const auto flat = [](int width, int height, double grey) {
    return Render([=](double, double) { return grey; }, width, height);
  };
  const std::vector<Image> images = {Moved(0.0, 0.0),
                                     flat(kWidth, kHeight, 0.0),
                                     flat(kWidth, kHeight, 255.0),
                                     flat(1, 1, 9.0),
                                     flat(0, 0, 0.0),
                                     flat(kWidth, 1, 7.0),
                                     flat(20, kHeight, 7.0),
                                     flat(kHeight, kWidth, 7.0),
                                     flat(21, 21, 7.0)};
  const std::vector<Eigen::Vector2f> points = {{0.0F, 0.0F}, {10.0F, 10.0F}, {150.0F, 120.0F}};
  for (size_t first = 0; first < images.size(); ++first) {
    for (size_t second = 0; second < images.size(); ++second) {
      if (first == 0 && second == 0) continue;
      EXPECT_EQ(Count(TrackBetween(images[first], images[second], points)), 0)
          << first << " " << second;
    }
  }
  EXPECT_EQ(Count(TrackBetween(images[0], images[0], {})), 0);
}

TEST(OpticalFlow, ThreadsDoNotChangeResults) {
  const int threads = cv::getNumThreads();
  const std::vector<Eigen::Vector2f> points = Grid(5.0F);
  cv::setNumThreads(1);
  const FlowResult one = TrackBetween(Moved(0.0, 0.0), Moved(4.4, 2.2), points);
  cv::setNumThreads(2);
  const FlowResult two = TrackBetween(Moved(0.0, 0.0), Moved(4.4, 2.2), points);
  cv::setNumThreads(threads);
  EXPECT_EQ(one.pixels, two.pixels);
  EXPECT_EQ(one.found, two.found);
  EXPECT_EQ(one.errors, two.errors);
}

TEST(OpticalFlow, RefusesWhatDoesNotFit) {
  OpticalFlow flow({});
  Image image;
  image.width = 4;
  image.height = 4;
  EXPECT_THROW(flow.Advance(image), CheckError);
  FlowResult result;
  EXPECT_THROW(flow.Track({{1.0F, 1.0F}}, {{1.0F, 1.0F}, {2.0F, 2.0F}}, &result), CheckError);
}

}  // namespace
}  // namespace regolith
