// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/corner_weight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "regolith/features/opencv_image_internal.h"
#include "regolith/features/test_texture_internal.h"

namespace regolith {
namespace {

ScoreMap Ones(const Image& image) {
  return {image.width, image.height,
          std::vector<float>(static_cast<size_t>(image.width) * static_cast<size_t>(image.height),
                             1.0F)};
}

TEST(CornerWeight, IsTheSmallerEigenvalueThatOpenCvFinds) {
  const Image image = TestTexture(3).View(160, 120, {5.0, -7.0});
  cv::Mat eigenvalues;
  cv::cornerMinEigenVal(ViewOf(image), eigenvalues, 5, 3);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(ViewOf(image), mean, deviation);
  const double unit = deviation[0] / 255.0 + 0.02;
  ScoreMap scores = Ones(image);
  CornerWeight weight;
  weight.Apply(image, &scores);
  weight.Apply(image, &(scores = Ones(image)));  // nothing of the last image is left
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const float found = scores.scores[static_cast<size_t>(row * image.width + column)];
      const bool edge =
          row < 3 || column < 3 || row >= image.height - 3 || column >= image.width - 3;
      const double eigenvalue = std::max(0.0F, eigenvalues.at<float>(row, column));
      const double expected = edge ? 0.0 : std::sqrt((eigenvalue / (unit * unit) + 0.003) / 0.0625);
      ASSERT_NEAR(found, expected, 1e-3 * (1.0 + expected)) << row << ", " << column;
    }
  }
}

TEST(CornerWeight, LeavesNothingOfImagesThatAreAllEdge) {
  const Image image{6, 9, std::vector<uint8_t>(54, 7)};
  ScoreMap scores = Ones(image);
  CornerWeight().Apply(image, &scores);
  EXPECT_EQ(scores.scores, std::vector<float>(54, 0.0F));
}

}  // namespace
}  // namespace regolith
