// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>

#include "regolith/factors/pose_manifold.h"
#include "regolith/geometry/so3.h"
#include "regolith/sensor/rectified_camera.h"

namespace regolith {

/// A point of a map seen by a rectified stereo pair (Mur-Artal & Tardós 2017, equations 2 to 4):
/// column and row in the left image, and with three rows the column in the right one, in standard
/// deviations. Blocks: T_world_camera of the left camera, the point (m, world). A point that is not
/// before the camera cannot be evaluated.
template <int kRows>
class PointProjectionFactor final : public ceres::SizedCostFunction<kRows, kPoseBlockSize, 3> {
  static_assert(kRows == 2 || kRows == 3, "one eye or both");

 public:
  /// `seen`: pixels, as RectifiedCamera::Project gives them; `sigma`: pixels.
  PointProjectionFactor(const RectifiedCamera& camera, const Eigen::Vector3d& seen, double sigma)
      : camera_(camera), seen_(seen), weight_(1.0 / sigma) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const SE3 T_world_camera = FromPoseBlock(blocks[0]);
    const Eigen::Matrix3d R_camera_world = T_world_camera.rotation.conjugate().toRotationMatrix();
    const Eigen::Vector3d point = R_camera_world * (Eigen::Map<const Eigen::Vector3d>(blocks[1]) -
                                                    T_world_camera.translation);
    if (point.z() < kNearest) return false;
    Eigen::Map<Eigen::Matrix<double, kRows, 1>>(residuals, kRows) =
        weight_ * (camera_.Project(point) - seen_).template head<kRows>();
    if (jacobians == nullptr) return true;
    const Eigen::Matrix<double, kRows, 3> by_point_camera =
        weight_ * camera_.ProjectionJacobian(point).template topRows<kRows>();
    Eigen::Matrix<double, 3, 6> by_pose;
    by_pose << Hat(point), -R_camera_world;
    WritePoseJacobian<kRows>(by_point_camera * by_pose, blocks[0], jacobians[0]);
    if (jacobians[1] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, kRows, 3, Eigen::RowMajor>>(jacobians[1], kRows, 3) =
          by_point_camera * R_camera_world;
    }
    return true;
  }

 private:
  static constexpr double kNearest = 1e-3;  // m

  RectifiedCamera camera_;
  Eigen::Vector3d seen_;
  double weight_;
};

using MonoProjectionFactor = PointProjectionFactor<2>;
using StereoProjectionFactor = PointProjectionFactor<3>;

}  // namespace regolith
