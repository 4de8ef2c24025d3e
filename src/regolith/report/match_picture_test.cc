// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/match_picture.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "regolith/core/check.h"

namespace regolith {
namespace {

struct GreyImage {
  int width;
  int height;
  std::vector<uint8_t> pixels;
  std::vector<Eigen::Vector2f> keypoints;

  GreyImage(int w, int h, uint8_t grey)
      : width(w), height(h), pixels(static_cast<size_t>(w) * static_cast<size_t>(h), grey) {}
  MatchPanel Panel() const { return {width, height, pixels, keypoints}; }
};

cv::Mat Draw(const GreyImage& first, const GreyImage& second, const std::vector<MatchLine>& lines,
             const std::vector<std::string>& caption = {}) {
  return cv::imdecode(DrawMatches(first.Panel(), second.Panel(), lines, caption), cv::IMREAD_COLOR);
}

int ChangedPixels(const cv::Mat& first, const cv::Mat& second) {
  cv::Mat difference;
  cv::absdiff(first, second, difference);
  return cv::countNonZero(difference.reshape(1));
}

TEST(MatchPicture, PutsTheImagesSideBySideAtOneScale) {
  const cv::Mat picture = Draw({640, 480, 50}, {320, 240, 200}, {});
  EXPECT_EQ(picture.cols, 960 + 6 + 480);
  EXPECT_EQ(picture.rows, 720);
  EXPECT_EQ(picture.at<cv::Vec3b>(700, 950), cv::Vec3b(50, 50, 50));
  EXPECT_EQ(picture.at<cv::Vec3b>(350, 970), cv::Vec3b(200, 200, 200));
  EXPECT_EQ(picture.at<cv::Vec3b>(370, 970), cv::Vec3b(255, 255, 255));
}

TEST(MatchPicture, ReducesHugeImagesAndEnlargesTinyOnes) {
  EXPECT_EQ(Draw({9600, 4800, 50}, {9600, 4800, 50}, {}).rows, 480);
  const cv::Mat tiny = Draw({1, 1, 50}, {1, 1, 60}, {{{0, 0}, {0, 0}}}, {"a caption"});
  EXPECT_GE(tiny.cols, 80);
  EXPECT_GE(tiny.rows, 16 + 26);
}

TEST(MatchPicture, LinesRunFromOnePixelToTheOther) {
  const GreyImage first(960, 480, 0);
  const cv::Mat picture = Draw(first, first, {{{100, 200}, {300, 200}, MatchStyle::kWrong}});
  for (const int column : {105, 500, 966 + 295}) {
    EXPECT_GT(picture.at<cv::Vec3b>(200, column)[2], 150) << column;
  }
  EXPECT_EQ(picture.at<cv::Vec3b>(200, 90), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(picture.at<cv::Vec3b>(200, 966 + 310), cv::Vec3b(0, 0, 0));
}

TEST(MatchPicture, StylesDifferAndRejectedOnesAreFaint) {
  const GreyImage image(960, 480, 0);
  const auto colour = [&](MatchStyle style) {
    return Draw(image, image, {{{100, 200}, {300, 200}, style}}).at<cv::Vec3b>(200, 500);
  };
  const cv::Vec3b correct = colour(MatchStyle::kCorrect);
  const cv::Vec3b wrong = colour(MatchStyle::kWrong);
  EXPECT_GT(correct[1], correct[2] + 50);
  EXPECT_GT(wrong[2], wrong[1] + 50);
  EXPECT_EQ(colour(MatchStyle::kKept), correct);
  EXPECT_LT(cv::norm(colour(MatchStyle::kRejected)), 0.6 * cv::norm(correct));
  EXPECT_GT(cv::norm(colour(MatchStyle::kRejected)), 0.0);
}

TEST(MatchPicture, KeypointsAreRedWhereTheyAre) {
  GreyImage first(960, 480, 0);
  const cv::Mat without = Draw(first, first, {});
  first.keypoints = {{200.0F, 100.0F}};
  const cv::Mat with = Draw(first, {960, 480, 0}, {});
  cv::Mat difference;
  cv::absdiff(with, without, difference);
  std::vector<cv::Mat> channels;
  cv::split(difference, channels);
  const cv::Moments moments = cv::moments(channels[2]);
  EXPECT_NEAR(moments.m10 / moments.m00, 200.0, 0.3);
  EXPECT_NEAR(moments.m01 / moments.m00, 100.0, 0.3);
  EXPECT_GT(cv::sum(channels[2])[0], 3 * cv::sum(channels[1])[0]);
}

TEST(MatchPicture, SameValuesSameBytesAndFarPixelsDoNoHarm) {
  GreyImage image(64, 48, 90);
  image.keypoints = {{1, 2}, {1e9F, -1e9F}};
  const std::vector<MatchLine> lines = {{{3, 4}, {1e9F, 7}, MatchStyle::kKept}};
  EXPECT_EQ(DrawMatches(image.Panel(), image.Panel(), lines, {"found 1"}),
            DrawMatches(image.Panel(), image.Panel(), lines, {"found 1"}));
  EXPECT_GT(ChangedPixels(Draw(image, image, {}, {"one"}), Draw(image, image, {}, {"two"})), 0);
}

TEST(MatchPicture, PixelsMustFitTheSize) {
  GreyImage image(64, 48, 90);
  image.width = 65;
  EXPECT_THROW(DrawMatches(image.Panel(), image.Panel(), {}, {}), CheckError);
}

}  // namespace
}  // namespace regolith
