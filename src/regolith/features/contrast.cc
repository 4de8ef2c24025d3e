// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/contrast.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace regolith {
namespace {

constexpr double kMostGain = 4.0;
constexpr double kOutliers = 0.001;  // share of the pixels at each end that do not count

}  // namespace

double ContrastStretch::Apply(double value) const {
  return std::clamp((value - low) * gain, 0.0, 1.0);
}

ContrastStretch StretchFor(const Image& image) {
  ContrastStretch stretch;
  if (image.data.empty()) return stretch;
  std::array<size_t, 256> histogram{};
  for (const uint8_t grey : image.data) ++histogram[grey];
  const auto ignored = static_cast<size_t>(kOutliers * static_cast<double>(image.data.size()));
  int darkest = 0;
  int brightest = 255;
  for (size_t count = histogram[0]; darkest < 255 && count <= ignored;) {
    count += histogram[static_cast<size_t>(++darkest)];
  }
  for (size_t count = histogram[255]; brightest > 0 && count <= ignored;) {
    count += histogram[static_cast<size_t>(--brightest)];
  }
  if (brightest <= darkest) return stretch;
  stretch.gain = std::min(255.0 / (brightest - darkest), kMostGain);
  stretch.low = darkest / 255.0;
  return stretch;
}

double LocalContrast(const Image& image, int column, int row) {
  constexpr int kRadius = 3;
  const int left = std::max(0, column - kRadius);
  const int right = std::min(image.width - 1, column + kRadius);
  const int top = std::max(0, row - kRadius);
  const int bottom = std::min(image.height - 1, row + kRadius);
  int sum = 0;
  int squares = 0;
  for (int y = top; y <= bottom; ++y) {
    const uint8_t* greys =
        image.data.data() + static_cast<size_t>(y) * static_cast<size_t>(image.width);
    for (int x = left; x <= right; ++x) {
      sum += greys[x];
      squares += greys[x] * greys[x];
    }
  }
  const int count = (right - left + 1) * (bottom - top + 1);
  if (count <= 0) return 0.0;
  const double mean = static_cast<double>(sum) / count;
  return std::sqrt(std::max(0.0, static_cast<double>(squares) / count - mean * mean));
}

}  // namespace regolith
