// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/contrast.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regolith {
namespace {

/// A ramp of `width` grey levels from `low` to `high`.
Image Ramp(int low, int high) {
  Image image{high - low + 1, 100, {}};
  for (int row = 0; row < 100; ++row) {
    for (int grey = low; grey <= high; ++grey) image.data.push_back(static_cast<uint8_t>(grey));
  }
  return image;
}

TEST(StretchFor, LeavesAnImageThatUsesItsRange) {
  const ContrastStretch stretch = StretchFor(Ramp(0, 255));
  EXPECT_DOUBLE_EQ(stretch.gain, 1.0);
  EXPECT_DOUBLE_EQ(stretch.low, 0.0);
}

TEST(StretchFor, BringsADarkImageToFullRange) {
  const ContrastStretch stretch = StretchFor(Ramp(20, 120));
  EXPECT_NEAR(stretch.Apply(20 / 255.0), 0.0, 1e-9);
  EXPECT_NEAR(stretch.Apply(120 / 255.0), 1.0, 1e-9);
  EXPECT_NEAR(stretch.Apply(70 / 255.0), 0.5, 1e-9);
}

TEST(StretchFor, DoesNotMakeNoiseASignal) {
  EXPECT_DOUBLE_EQ(StretchFor(Ramp(3, 6)).gain, 4.0);
  Image black{10, 10, std::vector<uint8_t>(100, 0)};
  EXPECT_DOUBLE_EQ(StretchFor(black).gain, 1.0);
  EXPECT_DOUBLE_EQ(StretchFor(Image()).gain, 1.0);
}

TEST(LocalContrast, IsTheStandardDeviationAround) {
  // Columns alternate between 10 and 14: three and four of each in a window of 7.
  Image image{20, 20, {}};
  for (int i = 0; i < 400; ++i) image.data.push_back(i % 2 == 0 ? 10 : 14);
  EXPECT_NEAR(LocalContrast(image, 10, 10), 4.0 * std::sqrt(3.0 * 4.0 / 49.0), 1e-9);
  EXPECT_NEAR(LocalContrast(image, 0, 0), 2.0, 1e-9);
  const Image flat{5, 5, std::vector<uint8_t>(25, 200)};
  EXPECT_EQ(LocalContrast(flat, 2, 2), 0.0);
}

}  // namespace
}  // namespace regolith
