// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <opencv2/core/mat.hpp>

#include "regolith/sensor/image.h"

namespace regolith {

/// The image as OpenCV sees it, without a copy. OpenCV has no view of constant pixels; do not write
/// through it.
inline cv::Mat ViewOf(const Image& image) {
  return {image.height, image.width, CV_8UC1, const_cast<uint8_t*>(image.data.data()),
          static_cast<size_t>(image.width)};
}

}  // namespace regolith
