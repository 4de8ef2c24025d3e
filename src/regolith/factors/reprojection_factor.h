// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>

#include "regolith/factors/ray_transfer.h"

namespace regolith {

/// A landmark seen by one moving camera from two poses of its body: inverse distance along the
/// first bearing, error on the unit sphere at the second (Qin et al. 2018, section V-C, with the
/// sphere in the place of the image plane; Qin & Shen 2018 for the time offset). Blocks: pose i,
/// pose j (T_world_imu), T_imu_camera, inverse distance (1/m, one value), time offset of the camera
/// (s, one value: what is added to its stamps). Two residuals in standard deviations.
class ReprojectionFactor final
    : public ceres::SizedCostFunction<2, kPoseBlockSize, kPoseBlockSize, kPoseBlockSize, 1, 1> {
 public:
  /// `sigma`: rad, of the difference between the two bearings.
  ReprojectionFactor(const FeatureSighting& first, const FeatureSighting& second, double sigma)
      : first_(first), second_(second), sigma_(sigma), plane_(TangentPlane(second.bearing)) {}

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const SE3 T_imu_camera = FromPoseBlock(blocks[2]);
    const double time_offset = blocks[4][0];
    // A pose is that of its frame's time. Where the offset has grown since, the image was taken
    // later than that: at the pose's time the bearing was an earlier one.
    const Eigen::Vector3d source =
        first_.bearing - (time_offset - first_.time_offset) * first_.bearing_rate;
    const Eigen::Vector3d target =
        second_.bearing - (time_offset - second_.time_offset) * second_.bearing_rate;
    const RayTransfer transfer(FromPoseBlock(blocks[0]), FromPoseBlock(blocks[1]), T_imu_camera,
                               T_imu_camera, source, blocks[3][0], jacobians != nullptr);
    const BearingError error(transfer.ray_target, target, plane_, sigma_);
    Eigen::Map<Eigen::Vector2d>(residuals, 2) = error.value;
    if (jacobians == nullptr) return true;
    WritePoseJacobian<2>(error.by_ray * transfer.by_pose_i, blocks[0], jacobians[0]);
    WritePoseJacobian<2>(error.by_ray * transfer.by_pose_j, blocks[1], jacobians[1]);
    WritePoseJacobian<2>(error.by_ray * (transfer.by_source + transfer.by_target), blocks[2],
                         jacobians[2]);
    if (jacobians[3] != nullptr) {
      Eigen::Map<Eigen::Vector2d>(jacobians[3], 2) = error.by_ray * transfer.by_inverse_distance;
    }
    if (jacobians[4] != nullptr) {
      Eigen::Map<Eigen::Vector2d>(jacobians[4], 2) =
          -(error.by_ray * transfer.by_bearing * first_.bearing_rate +
            error.by_bearing * second_.bearing_rate);
    }
    return true;
  }

 private:
  FeatureSighting first_;
  FeatureSighting second_;
  double sigma_;
  Eigen::Matrix<double, 3, 2> plane_;
};

}  // namespace regolith
