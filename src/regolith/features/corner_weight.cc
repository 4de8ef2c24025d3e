// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/corner_weight.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr int kHalf = 2;  // of the block whose gradients are summed
constexpr size_t kBlock = 2 * kHalf + 1;
constexpr float kFlat = 0.003F;      // variances, added so that no place is ruled out
constexpr float kTypical = 0.0625F;  // variances, of a corner whose score stays as it is
constexpr double kNoise = 0.02;      // grey / 255, added to the deviation
// Sobel's gradient of a ramp of 1 is 8; OpenCV's scale (cv::cornerMinEigenVal) is kept.
constexpr double kScale = 1.0 / (4.0 * kBlock * 255.0);

/// Of the whole image, (grey / 255)².
double Variance(const Image& image) {
  int64_t sum = 0;
  int64_t squares = 0;
  for (const uint8_t grey : image.data) {
    sum += grey;
    squares += static_cast<int32_t>(grey) * grey;
  }
  const auto count = static_cast<double>(image.data.size());
  const double mean = static_cast<double>(sum) / count;
  const double variance = static_cast<double>(squares) / count - mean * mean;
  const double deviation = std::sqrt(std::max(variance, 0.0)) / 255.0 + kNoise;
  return deviation * deviation;
}

void SumFive(const std::vector<int32_t>& values, size_t width, int32_t* sums) {
  const int32_t* from = values.data();
  for (size_t x = 0; x + kBlock <= width; ++x) {
    sums[x + kHalf] = from[x] + from[x + 1] + from[x + 2] + from[x + 3] + from[x + 4];
  }
}

void Exchange(const std::vector<int32_t>& added, const std::vector<int32_t>& removed,
              std::vector<int32_t>* total) {
  int32_t* target = total->data();
  for (size_t x = 0; x < total->size(); ++x) target[x] += added[x] - removed[x];
}

}  // namespace

void CornerWeight::Apply(const Image& image, ScoreMap* scores) {
  REGOLITH_CHECK(image.width == scores->width && image.height == scores->height,
                 "image=", image.width, " × ", image.height, " scores=", scores->width, " × ",
                 scores->height);
  const auto width = static_cast<size_t>(image.width);
  const auto row_of = [&](int row) { return scores->scores.data() + row * image.width; };
  if (image.width <= 2 * kMargin || image.height <= 2 * kMargin) {
    std::fill(scores->scores.begin(), scores->scores.end(), 0.0F);
    return;
  }
  Resize(width);
  const double variance = Variance(image);
  for (int row = 1; row + 1 < image.height; ++row) {
    // What stood there is five rows old and leaves the total.
    Products& newest = rows_[static_cast<size_t>(row) % kBlock];
    std::swap(newest, rows_[kBlock]);
    SumColumns(image, row, &newest);
    Exchange(newest.xx, rows_[kBlock].xx, &total_.xx);
    Exchange(newest.xy, rows_[kBlock].xy, &total_.xy);
    Exchange(newest.yy, rows_[kBlock].yy, &total_.yy);
    if (row - kHalf >= kMargin) WeighRow(variance, row_of(row - kHalf));
  }
  for (int row = 0; row < kMargin; ++row) {
    std::fill_n(row_of(row), width, 0.0F);
    std::fill_n(row_of(image.height - 1 - row), width, 0.0F);
  }
}

void CornerWeight::Resize(size_t width) {
  rows_.resize(kBlock + 1);
  for (Products* products :
       {&rows_[0], &rows_[1], &rows_[2], &rows_[3], &rows_[4], &rows_[5], &total_}) {
    for (std::vector<int32_t>* values : {&products->xx, &products->xy, &products->yy}) {
      values->assign(width, 0);
    }
  }
  for (std::vector<int32_t>* values : {&xx_, &xy_, &yy_}) values->assign(width, 0);
}

void CornerWeight::SumColumns(const Image& image, int row, Products* sums) {
  const auto width = static_cast<size_t>(image.width);
  const uint8_t* here = image.data.data() + static_cast<size_t>(row) * width;
  const uint8_t* above = here - width;
  const uint8_t* below = here + width;
  for (size_t x = 1; x + 1 < width; ++x) {
    const int32_t along = 2 * (here[x + 1] - here[x - 1]) + (above[x + 1] - above[x - 1]) +
                          (below[x + 1] - below[x - 1]);
    const int32_t down =
        2 * (below[x] - above[x]) + (below[x - 1] - above[x - 1]) + (below[x + 1] - above[x + 1]);
    xx_[x] = along * along;
    xy_[x] = along * down;
    yy_[x] = down * down;
  }
  SumFive(xx_, width, sums->xx.data());
  SumFive(xy_, width, sums->xy.data());
  SumFive(yy_, width, sums->yy.data());
}

void CornerWeight::WeighRow(double variance, float* scores) const {
  const auto scale = static_cast<float>(0.5 * kScale * kScale / variance / kTypical);
  const size_t width = total_.xx.size();
  const auto inner = [&](const std::vector<int32_t>& values) {
    return Eigen::Map<const Eigen::ArrayXi>(values.data() + kMargin,
                                            static_cast<Eigen::Index>(width - 2 * kMargin))
        .cast<float>();
  };
  // Expressions of Eigen: a loop with std::sqrt is not vectorised, for the sake of errno.
  const auto difference = inner(total_.xx) - inner(total_.yy);
  const auto root = (difference.square() + 4.0F * inner(total_.xy).square()).sqrt();
  const auto smaller = inner(total_.xx) + inner(total_.yy) - root;
  Eigen::Map<Eigen::ArrayXf>(scores + kMargin, static_cast<Eigen::Index>(width - 2 * kMargin)) *=
      (smaller.max(0.0F) * scale + kFlat / kTypical).sqrt();
  std::fill_n(scores, kMargin, 0.0F);
  std::fill_n(scores + width - kMargin, kMargin, 0.0F);
}

}  // namespace regolith
