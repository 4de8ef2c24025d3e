// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace regolith {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid motion. T_a_b maps points of frame b into frame a: p_a = T_a_b * p_b.
/// Tangent vectors are [rotation (rad), position (m)]. Two perturbations are in use:
///   Plus:  R' = R Exp(φ), p' = p + δ   (the error state of NavState; position in frame a),
///   Exp:   T' = T Exp([φ, ρ])          (the group's own, position in frame b).
struct SE3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  SE3() = default;
  SE3(const Eigen::Quaterniond& rotation_in, const Eigen::Vector3d& translation_in)
      : rotation(rotation_in), translation(translation_in) {}

  static SE3 FromMatrix(const Eigen::Matrix4d& matrix);
  Eigen::Matrix4d Matrix() const;

  SE3 Inverse() const;
  SE3 operator*(const SE3& other) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
};

/// The group's exponential and logarithm (Solà et al. 2018, section D, rotation first here).
SE3 ExpSe3(const Vector6d& tangent);
Vector6d LogSe3(const SE3& transform);

/// T Exp(τ) T⁻¹ = Exp(Ad τ).
Matrix6d AdjointSe3(const SE3& transform);

/// Exp(τ + δ) ≈ Exp(τ) Exp(J δ), and its inverse.
Matrix6d RightJacobianSe3(const Vector6d& tangent);
Matrix6d RightJacobianInverseSe3(const Vector6d& tangent);

/// R' = R Exp(φ), p' = p + δ, with tangent = [φ, δ].
SE3 Plus(const SE3& transform, const Vector6d& tangent);
/// The tangent for which Plus(from, tangent) = to.
Vector6d Minus(const SE3& to, const SE3& from);

/// Rotation on the shortest arc and translation on a line; fraction 0 gives `from`, 1 gives `to`.
SE3 Interpolate(const SE3& from, const SE3& to, double fraction);

}  // namespace regolith
