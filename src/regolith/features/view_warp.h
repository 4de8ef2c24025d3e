// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/sensor/image.h"

namespace regolith {

/// The homography that takes pixels of the first image to the second as most of the inliers do
/// within a few pixels: that of the ground, as far as it is a plane. Nothing where there is none,
/// or fewer than ten inliers follow it. Deterministic (MAGSAC, Barath et al. 2019, OpenCV's).
std::optional<Eigen::Matrix3d> PlaneHomography(const std::vector<Eigen::Vector2f>& first,
                                               const std::vector<Eigen::Vector2f>& second,
                                               const std::vector<uint8_t>& inliers);

/// By how much a homography of PlaneHomography enlarges areas at the places, the median of those on
/// the inliers' side of its horizon; 1 where there are none.
double MedianEnlargement(const Eigen::Matrix3d& homography,
                         const std::vector<Eigen::Vector2f>& places);

/// An image as another view shows it.
struct WarpedView {
  Image image;  ///< beyond the image's edges its last pixels go on
  Image mask;   ///< 0 there, and within a border along the edges
};

/// Bilinear, `width` × `height` pixels; the border is of pixels of the image.
WarpedView WarpImage(const Image& image, const Eigen::Matrix3d& H_view_image, int width, int height,
                     int border);

}  // namespace regolith
