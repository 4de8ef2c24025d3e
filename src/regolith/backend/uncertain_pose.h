// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/geometry/se3.h"

namespace regolith {

/// A relative pose and what it may be off by: T_a_b Exp(ξ) with ξ = [rotation (rad), position (m)]
/// in frame b, so that covariances move through compositions by adjoints alone (Barfoot and Furgale
/// 2014, first order). Directions of which nothing is known have kUnknownVariance.
struct UncertainPose {
  SE3 T_a_b;
  Matrix6d covariance = Matrix6d::Zero();
};

inline constexpr double kUnknownVariance = 1e4;  ///< rad² or m²

/// a → c from a → b and b → c.
UncertainPose Compose(const UncertainPose& a_b, const UncertainPose& b_c);
UncertainPose Inverse(const UncertainPose& a_b);
/// Two independent measurements of one pose as one.
UncertainPose Fuse(const UncertainPose& first, const UncertainPose& second);

/// Covariance of T as Plus(T, ·) perturbs it (position in the target frame) into that of
/// T Exp(·), and back.
Matrix6d PlusToExpCovariance(const Matrix6d& covariance, const SE3& pose);
Matrix6d ExpToPlusCovariance(const Matrix6d& covariance, const SE3& pose);

/// Inverse of a symmetric matrix that may have directions without information: eigenvalues below
/// 1 / kUnknownVariance come out as kUnknownVariance, and back as 0.
Matrix6d CovarianceOf(const Matrix6d& information);
Matrix6d InformationOf(const Matrix6d& covariance);

/// W with Wᵀ W = information; rows of zeros for directions without information.
Matrix6d SquareRootOf(const Matrix6d& information);

/// Squared Mahalanobis distance between two poses of which both may be off: Log(first⁻¹ second)
/// against the sum of the covariances.
double SquaredDistance(const UncertainPose& first, const UncertainPose& second);

}  // namespace regolith
