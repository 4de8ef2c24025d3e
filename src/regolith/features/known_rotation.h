// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace regolith {

/// Two views whose rotation is known: only the direction of translation is not.
struct RotatedBearings {
  std::vector<Eigen::Vector3d> first;   ///< unit, turned into the second camera's frame
  std::vector<Eigen::Vector3d> second;  ///< unit, second camera's frame
};

struct TranslationSearch {
  double threshold = 0.0;  ///< rad; a bearing further from its epipolar plane is an outlier
  double confidence = 0.999;
  int max_iterations = 1000;
};

/// The direction of translation (t of X_second = R X_first + t, up to its sign) that most matches
/// agree with: RANSAC over pairs (Troiani et al. 2014). Deterministic. Any, where fewer than two
/// matches have parallax.
Eigen::Vector3d FindTranslation(const RotatedBearings& bearings, const TranslationSearch& search);

/// Which matches agree with it: they lie within the threshold (rad) of their epipolar planes and
/// before both cameras, for that sign of t which most prefer. Those without parallax agree with
/// every direction.
std::vector<uint8_t> AgreeWithTranslation(const RotatedBearings& bearings,
                                          const Eigen::Vector3d& direction, double threshold);

}  // namespace regolith
