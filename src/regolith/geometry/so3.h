// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace regolith {

/// Rotations: Hamilton quaternions, perturbed on the right, R ⊞ φ = R Exp(φ), φ in radians.
/// Formulas after Solà, Deray, Atchuthan 2018, "A micro Lie theory for state estimation in
/// robotics", appendix B.

/// The matrix of the cross product: Hat(a) b = a × b.
Eigen::Matrix3d Hat(const Eigen::Vector3d& vector);

Eigen::Quaterniond ExpSo3(const Eigen::Vector3d& rotation_vector);

/// The rotation vector of shortest length, in [0, π].
Eigen::Vector3d LogSo3(const Eigen::Quaterniond& rotation);

/// Exp(φ + δ) ≈ Exp(φ) Exp(J δ).
Eigen::Matrix3d RightJacobianSo3(const Eigen::Vector3d& rotation_vector);
Eigen::Matrix3d RightJacobianInverseSo3(const Eigen::Vector3d& rotation_vector);

/// Angle between two rotations, in [0, π] rad.
double AngleBetween(const Eigen::Quaterniond& first, const Eigen::Quaterniond& second);

/// Angle between two vectors of any length, in [0, π] rad; exact for small angles too.
double AngleBetween(const Eigen::Vector3d& first, const Eigen::Vector3d& second);

/// The smallest rotation that turns unit vector `from` onto unit vector `to`.
Eigen::Quaterniond RotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace regolith
