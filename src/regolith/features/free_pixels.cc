// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/free_pixels.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"

namespace regolith {

void FreePixels::Reset(int width, int height, const Image* mask, int border) {
  REGOLITH_CHECK(mask == nullptr || (mask->width == width && mask->height == height), "image of ",
                 width, " × ", height);
  image_.width = width;
  image_.height = height;
  const size_t row_size = static_cast<size_t>(width);
  if (mask != nullptr) {
    image_.data = mask->data;
  } else {
    image_.data.assign(row_size * static_cast<size_t>(height), 255);
  }
  const auto side = static_cast<std::ptrdiff_t>(std::min(border, width));
  for (int row = 0; row < height; ++row) {
    const auto begin = image_.data.begin() + static_cast<std::ptrdiff_t>(row) * width;
    if (row < border || row >= height - border) {
      std::fill(begin, begin + width, uint8_t{0});
    } else {
      std::fill(begin, begin + side, uint8_t{0});
      std::fill(begin + width - side, begin + width, uint8_t{0});
    }
  }
}

bool FreePixels::IsFree(const Eigen::Vector2f& pixel) const {
  // Written so that NaN is not free.
  const bool inside = pixel.x() >= -0.5F && pixel.y() >= -0.5F &&
                      pixel.x() < static_cast<float>(image_.width) - 0.5F &&
                      pixel.y() < static_cast<float>(image_.height) - 0.5F;
  if (!inside) return false;
  return image_.At(static_cast<int>(std::floor(pixel.x() + 0.5F)),
                   static_cast<int>(std::floor(pixel.y() + 0.5F))) != 0;
}

void FreePixels::Take(const Eigen::Vector2f& pixel, int radius) {
  const auto reach = static_cast<float>(radius);
  const int first_row = std::max(0, static_cast<int>(std::ceil(pixel.y() - reach)));
  const int last_row = std::min(image_.height - 1, static_cast<int>(std::floor(pixel.y() + reach)));
  for (int row = first_row; row <= last_row; ++row) {
    const float dy = static_cast<float>(row) - pixel.y();
    for (int column = std::max(0, static_cast<int>(std::ceil(pixel.x() - reach)));
         column < image_.width && static_cast<float>(column) <= pixel.x() + reach; ++column) {
      const float dx = static_cast<float>(column) - pixel.x();
      if (dx * dx + dy * dy < reach * reach) {
        image_.data[static_cast<size_t>(row) * static_cast<size_t>(image_.width) +
                    static_cast<size_t>(column)] = 0;
      }
    }
  }
}

}  // namespace regolith
