// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/geometry/se3.h"

namespace regolith {

/// One of the views of a point.
struct PointView {
  SE3 T_world_camera;
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  ///< unit, camera frame
};

/// A point from its views.
struct TriangulatedPoint {
  Eigen::Vector3d point_world = Eigen::Vector3d::Zero();
  double parallax =
      0.0;  ///< rad, the largest angle at the point between the first view and another
};

/// The point nearest to all rays (linear least squares, two rounds with the distances as weights).
/// Nothing where the rays are parallel or the point lies behind a camera.
std::optional<TriangulatedPoint> Triangulate(const std::vector<PointView>& views);

}  // namespace regolith
