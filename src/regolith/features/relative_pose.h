// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/features/known_rotation.h"

namespace regolith {

/// What two views say of a camera's motion: X_second = R X_first + (unknown length) direction.
struct RelativePose {
  Eigen::Matrix3d R_second_first = Eigen::Matrix3d::Identity();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit, up to its sign
};

/// The one of the two rotations in an essential matrix that most matches agree with. Bearings of
/// the first camera are in its own frame here (rotation not known), `threshold` is in rad.
RelativePose PoseOfEssential(const RotatedBearings& bearings, const Eigen::Matrix3d& E_second_first,
                             double threshold);

/// Least squares of the angles (of about `threshold` rad) between bearings and epipolar planes,
/// with weights that leave out what is far off.
RelativePose RefineRelativePose(const RotatedBearings& bearings, const RelativePose& initial,
                                double threshold);

}  // namespace regolith
