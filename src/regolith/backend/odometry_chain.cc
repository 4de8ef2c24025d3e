// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/odometry_chain.h"

#include <Eigen/Eigenvalues>

#include "regolith/core/check.h"

namespace regolith {

void OdometryChain::Append(const SE3& T_odom_body, const Matrix6d& step_covariance) {
  Link link;
  link.T_odom_body = T_odom_body;
  if (!links_.empty()) {
    const Matrix6d adjoint = AdjointSe3(T_odom_body);
    link.sum_odom = links_.back().sum_odom + adjoint * step_covariance * adjoint.transpose();
  }
  links_.push_back(link);
}

UncertainPose OdometryChain::Between(size_t from, size_t to) const {
  REGOLITH_CHECK(from < size() && to < size(), "from ", from, " to ", to, " among ", size());
  if (from > to) return Inverse(Between(to, from));
  const SE3 T_to_odom = links_[to].T_odom_body.Inverse();
  const Matrix6d adjoint = AdjointSe3(T_to_odom);
  return {links_[from].T_odom_body.Inverse() * links_[to].T_odom_body,
          adjoint * (links_[to].sum_odom - links_[from].sum_odom) * adjoint.transpose()};
}

Matrix6d StepCovariance(const SE3& T_odom_from, const Matrix6d& covariance_from,
                        const SE3& T_odom_to, const Matrix6d& covariance_to,
                        double floor_rotation_sigma, double floor_position_sigma) {
  const Matrix6d adjoint = AdjointSe3(T_odom_to.Inverse() * T_odom_from);
  const Matrix6d grown =
      PlusToExpCovariance(covariance_to, T_odom_to) -
      adjoint * PlusToExpCovariance(covariance_from, T_odom_from) * adjoint.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(0.5 * (grown + grown.transpose()));
  const Vector6d values = solver.eigenvalues().cwiseMax(0.0);
  Matrix6d covariance =
      solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
  covariance.diagonal().head<3>().array() += floor_rotation_sigma * floor_rotation_sigma;
  covariance.diagonal().tail<3>().array() += floor_position_sigma * floor_position_sigma;
  return covariance;
}

}  // namespace regolith
