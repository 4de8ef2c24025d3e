// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>

#include "regolith/factors/pose_manifold.h"
#include "regolith/geometry/so3.h"
#include "regolith/sensor/rectified_camera.h"

namespace regolith {

/// Brings errors of RectifiedCamera::Project into standard deviations: `sigma` of the left column
/// and row, `disparity_sigma` of the columns' difference (pixels). A keypoint that lies a little
/// beside its point does so in both eyes, since the right column is found by what the left image
/// shows there: so it is the disparity that has an error of its own, not the right column.
inline Eigen::Matrix3d StereoWhitening(double sigma, double disparity_sigma) {
  Eigen::Matrix3d whitening;
  whitening << 1.0 / sigma, 0.0, 0.0,  //
      0.0, 1.0 / sigma, 0.0,           //
      1.0 / disparity_sigma, 0.0, -1.0 / disparity_sigma;
  return whitening;
}

/// A point of a map seen by a rectified stereo pair (after Mur-Artal & Tardós 2017, equations 2 to
/// 4): column and row in the left image, and with three rows the disparity, in standard deviations.
/// Blocks: T_world_camera of the left camera, the point (m, world). A point that is not before the
/// camera cannot be evaluated.
template <int kRows>
class PointProjectionFactor final : public ceres::SizedCostFunction<kRows, kPoseBlockSize, 3> {
  static_assert(kRows == 2 || kRows == 3, "one eye or both");

 public:
  /// `seen`: pixels, as RectifiedCamera::Project gives them; sigmas as for StereoWhitening.
  PointProjectionFactor(const RectifiedCamera& camera, const Eigen::Vector3d& seen, double sigma,
                        double disparity_sigma)
      : camera_(camera),
        seen_(seen),
        whitening_(StereoWhitening(sigma, disparity_sigma).topRows<kRows>()) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const SE3 T_world_camera = FromPoseBlock(blocks[0]);
    const Eigen::Matrix3d R_camera_world = T_world_camera.rotation.conjugate().toRotationMatrix();
    const Eigen::Vector3d point = R_camera_world * (Eigen::Map<const Eigen::Vector3d>(blocks[1]) -
                                                    T_world_camera.translation);
    if (point.z() < kNearest) return false;
    Eigen::Map<Eigen::Matrix<double, kRows, 1>>(residuals, kRows) =
        whitening_ * (camera_.Project(point) - seen_);
    if (jacobians == nullptr) return true;
    const Eigen::Matrix<double, kRows, 3> by_point_camera =
        whitening_ * camera_.ProjectionJacobian(point);
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
  Eigen::Matrix<double, kRows, 3> whitening_;
};

using MonoProjectionFactor = PointProjectionFactor<2>;
using StereoProjectionFactor = PointProjectionFactor<3>;

}  // namespace regolith
