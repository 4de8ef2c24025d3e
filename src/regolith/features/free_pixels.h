// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/sensor/image.h"

namespace regolith {

/// Where keypoints may still lie: the mask that was given, less the border and less a disc around
/// every keypoint taken. Keeps its storage.
class FreePixels {
 public:
  /// `mask` may be null.
  void Reset(int width, int height, const Image* mask, int border);

  /// Whether the pixel lies in the image and is free.
  bool IsFree(const Eigen::Vector2f& pixel) const;
  /// Takes all pixels nearer than `radius`.
  void Take(const Eigen::Vector2f& pixel, int radius);

  /// 0 where taken.
  const Image& image() const { return image_; }

 private:
  Image image_;
};

}  // namespace regolith
