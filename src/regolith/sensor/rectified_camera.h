// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace regolith {

/// A stereo pair whose images are those of two equal pinholes without distortion that look the same
/// way, the right one `baseline` along the x axis of the left one. What is seen in both lies in one
/// row. Camera frame: the left one's, x right, y down, z forward.
struct RectifiedCamera {
  int width = 0;                                              ///< pixels
  int height = 0;                                             ///< pixels
  double focal = 0.0;                                         ///< pixels
  Eigen::Vector2d principal_point = Eigen::Vector2d::Zero();  ///< pixels
  double baseline = 0.0;                                      ///< m

  /// Column, row and column in the right image (pixels) of a point (m) before the camera.
  Eigen::Vector3d Project(const Eigen::Vector3d& point_camera) const {
    const double inverse = 1.0 / point_camera.z();
    const double column = focal * point_camera.x() * inverse + principal_point.x();
    return {column, focal * point_camera.y() * inverse + principal_point.y(),
            column - focal * baseline * inverse};
  }

  /// Of Project, by the point.
  Eigen::Matrix3d ProjectionJacobian(const Eigen::Vector3d& point_camera) const {
    const double inverse = 1.0 / point_camera.z();
    const double by_side = focal * inverse;
    const Eigen::Vector2d by_depth = -by_side * inverse * point_camera.head<2>();
    Eigen::Matrix3d jacobian;
    jacobian << by_side, 0.0, by_depth.x(),  //
        0.0, by_side, by_depth.y(),          //
        by_side, 0.0, by_depth.x() + by_side * inverse * baseline;
    return jacobian;
  }

  /// The depth (m, along z) of a disparity (pixels, above 0).
  double Depth(double disparity) const { return focal * baseline / disparity; }

  /// The point (m) that is seen at a pixel at this depth (m).
  Eigen::Vector3d PointAt(const Eigen::Vector2d& pixel, double depth) const {
    const Eigen::Vector2d side = (pixel - principal_point) * (depth / focal);
    return {side.x(), side.y(), depth};
  }

  /// Whether the pixel lies in the left image.
  bool Contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= width - 1.0 &&
           pixel.y() <= height - 1.0;
  }
};

}  // namespace regolith
