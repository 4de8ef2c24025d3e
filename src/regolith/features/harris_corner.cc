// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/harris_corner.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace regolith {
namespace {

constexpr int kHalfBlock = 3;
constexpr float kHarrisK = 0.04F;
// Sobel's kernel sums four differences of grey levels of 0…255 over two pixels.
constexpr float kGradientScale = 1.0F / (4.0F * 7.0F * 255.0F);

// Half the width of each row of the disc.
std::array<int, kPatchReach + 1> DiscWidths() {
  std::array<int, kPatchReach + 1> widths{};
  for (int row = 0; row <= kPatchReach; ++row) {
    widths[static_cast<size_t>(row)] =
        static_cast<int>(std::lround(std::sqrt(double{kPatchReach} * kPatchReach - row * row)));
  }
  return widths;
}

}  // namespace

float HarrisResponse(const PixelView& image, int column, int row) {
  int xx = 0;
  int yy = 0;
  int xy = 0;
  for (int dy = -kHalfBlock; dy <= kHalfBlock; ++dy) {
    const uint8_t* here = image.data + (row + dy) * image.stride + column;
    const uint8_t* above = here - image.stride;
    const uint8_t* below = here + image.stride;
    for (int dx = -kHalfBlock; dx <= kHalfBlock; ++dx) {
      const int x = 2 * (here[dx + 1] - here[dx - 1]) + (above[dx + 1] - above[dx - 1]) +
                    (below[dx + 1] - below[dx - 1]);
      const int y = 2 * (below[dx] - above[dx]) + (below[dx - 1] - above[dx - 1]) +
                    (below[dx + 1] - above[dx + 1]);
      xx += x * x;
      yy += y * y;
      xy += x * y;
    }
  }
  constexpr float kScale = kGradientScale * kGradientScale;
  const float a = static_cast<float>(xx) * kScale;
  const float b = static_cast<float>(yy) * kScale;
  const float c = static_cast<float>(xy) * kScale;
  return a * b - c * c - kHarrisK * (a + b) * (a + b);
}

float PatchAngle(const PixelView& image, int column, int row) {
  static const std::array<int, kPatchReach + 1> kWidths = DiscWidths();
  int moment_x = 0;
  int moment_y = 0;
  const uint8_t* centre = image.data + row * image.stride + column;
  for (int dy = -kPatchReach; dy <= kPatchReach; ++dy) {
    const uint8_t* line = centre + dy * image.stride;
    const int width = kWidths[static_cast<size_t>(std::abs(dy))];
    int sum = 0;
    for (int dx = -width; dx <= width; ++dx) {
      sum += line[dx];
      moment_x += dx * line[dx];
    }
    moment_y += dy * sum;
  }
  return std::atan2(static_cast<float>(moment_y), static_cast<float>(moment_x));
}

}  // namespace regolith
