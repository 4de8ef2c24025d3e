// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "regolith/sensor/image.h"

namespace regolith {

/// What an image looks like around a keypoint, so that the same place can be found in another image
/// to a fraction of a pixel, however exact the detector is.
struct KeypointPatch {
  static constexpr int kReach = 10;  ///< pixels to either side of the centre
  static constexpr int kSide = 2 * kReach + 1;

  Eigen::Vector2i centre = Eigen::Vector2i::Zero();   ///< pixel of the image
  std::array<uint8_t, size_t{kSide} * kSide> grey{};  ///< rows one after the other
};

/// Around the pixel nearest to `place`; what lies outside the image repeats its edge.
KeypointPatch CutPatch(const Image& image, const Eigen::Vector2f& place);

/// The place in `second` that looks as `first_place` does in `first`, near `second_place`: pixels
/// of the images. `first_by_second`: how a step in the second image moves in the first (Jacobian).
/// Lucas–Kanade with the template's gradients (Baker & Matthews 2004, inverse compositional),
/// after both are freed of contrast and of the plane through their values: halo around the rover's
/// shadow, vignetting and scattered light go along with the camera, not with the ground. Nothing
/// where the patch says too little of the place or it is not found: correlation below
/// `min_correlation`, or farther than `max_step` pixels.
std::optional<Eigen::Vector2f> AlignPatch(const KeypointPatch& first,
                                          const Eigen::Vector2f& first_place,
                                          const KeypointPatch& second,
                                          const Eigen::Vector2f& second_place,
                                          const Eigen::Matrix2f& first_by_second,
                                          double min_correlation, double max_step);

}  // namespace regolith
