// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/features/feature_options.h"

namespace regolith {

/// Correspondences of two images: row i of one belongs to row i of the other.
struct Correspondences {
  std::vector<Eigen::Vector2f> first;   ///< pixels
  std::vector<Eigen::Vector2f> second;  ///< pixels
  /// Unit bearings (camera frame) of the same rows; empty where the camera is not known.
  std::vector<Eigen::Vector3d> first_bearings;
  std::vector<Eigen::Vector3d> second_bearings;
};

struct OutlierRejection {
  std::vector<uint8_t> inliers;  ///< one a row
  int inlier_count = 0;
  /// What decided: "fundamental", "essential", "rotation" (2-point with known rotation), or "none"
  /// where there were too few matches for epipolar geometry.
  const char* model = "none";
};

/// Says which correspondences agree with one rigid motion of the camera and with the motion of
/// their neighbours in the image. Without bearings the fundamental matrix, with them the essential
/// matrix (both by MAGSAC, Barath et al. 2019, OpenCV's), or, where `R_second_first` (first camera
/// frame into second) is known too, the direction of translation alone, from two points (RANSAC of
/// ours; Troiani et al. 2014). `focal` (pixels) turns pixels into angles for the last two.
/// Deterministic.
///
/// Fewer than min_matches, and those for which no model is found, are judged by their neighbours
/// alone; fewer than eight are all kept. Rows with values that are not finite, and with bearings
/// that point backwards (z <= 0), are outliers.
OutlierRejection RejectOutliers(const Correspondences& matches, double focal,
                                const std::optional<Eigen::Quaterniond>& R_second_first,
                                const OutlierRejectionOptions& options);

}  // namespace regolith
