// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/manifold.h>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/geometry/se3.h"

namespace regolith {

/// A pose as a Ceres parameter block: [x y z w of the quaternion, position (m)].
inline constexpr int kPoseBlockSize = 7;
using PoseBlock = Eigen::Matrix<double, kPoseBlockSize, 1>;

inline PoseBlock ToPoseBlock(const SE3& pose) {
  PoseBlock block;
  block << pose.rotation.coeffs(), pose.translation;
  return block;
}

inline SE3 FromPoseBlock(const double* block) {
  SE3 pose(Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(block)),
           Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(block + 4)));
  pose.rotation.normalize();
  return pose;
}

/// d Minus(block, pose) / d block at the pose itself. With [φ/2, 1] for small φ the quaternion
/// moves by ½ L(q) φ, where the columns of L are orthonormal: its left inverse is 2 Lᵀ (Solà 2017,
/// eq. 18).
inline Eigen::Matrix<double, 6, kPoseBlockSize, Eigen::RowMajor> PoseMinusJacobian(
    const double* block) {
  const double x = block[0];
  const double y = block[1];
  const double z = block[2];
  const double w = block[3];
  Eigen::Matrix<double, 4, 3> left;
  left << w, -z, y, z, w, -x, -y, x, w, -x, -y, -z;
  Eigen::Matrix<double, 6, kPoseBlockSize, Eigen::RowMajor> jacobian;
  jacobian.setZero();
  jacobian.topLeftCorner<3, 4>() = 2.0 * left.transpose();
  jacobian.bottomRightCorner<3, 3>().setIdentity();
  return jacobian;
}

/// Writes a derivative by the tangent of a pose as Ceres wants it, by the block's seven values.
/// `jacobian`: kRows × 7, row by row; null where it is not wanted.
template <int kRows>
void WritePoseJacobian(const Eigen::Matrix<double, kRows, 6>& by_tangent, const double* block,
                       double* jacobian) {
  if (jacobian == nullptr) return;
  Eigen::Map<Eigen::Matrix<double, kRows, kPoseBlockSize, Eigen::RowMajor>> written(jacobian);
  written = by_tangent * PoseMinusJacobian(block);
}

/// Poses perturbed as Plus(T, [φ, δ]) of geometry/se3.h: rotation on the right, position in the
/// pose's own target frame.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return kPoseBlockSize; }
  int TangentSize() const override { return 6; }

  bool Plus(const double* block, const double* tangent, double* moved) const override {
    Eigen::Map<PoseBlock>(moved, kPoseBlockSize) =
        ToPoseBlock(regolith::Plus(FromPoseBlock(block), Eigen::Map<const Vector6d>(tangent)));
    return true;
  }

  bool PlusJacobian(const double* block, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, kPoseBlockSize, 6, Eigen::RowMajor>> plus(jacobian);
    plus = PoseMinusJacobian(block).transpose();
    plus.topLeftCorner<4, 3>() *= 0.25;  // 2 L back to ½ L
    return true;
  }

  bool Minus(const double* to, const double* from, double* tangent) const override {
    Eigen::Map<Vector6d>(tangent, 6) = regolith::Minus(FromPoseBlock(to), FromPoseBlock(from));
    return true;
  }

  bool MinusJacobian(const double* block, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, kPoseBlockSize, Eigen::RowMajor>> minus(jacobian);
    minus = PoseMinusJacobian(block);
    return true;
  }
};

}  // namespace regolith
