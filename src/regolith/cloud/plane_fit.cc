// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/plane_fit.h"

#include <Eigen/Eigenvalues>

#include "regolith/core/check.h"

namespace regolith {

PlaneFit FitPlane(Span<const Eigen::Vector3d> points) {
  REGOLITH_CHECK(points.size() >= 3, points.size(), " points");
  const auto count = static_cast<double>(points.size());
  PlaneFit fit;
  for (const Eigen::Vector3d& point : points) fit.centroid += point;
  fit.centroid /= count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d centred = point - fit.centroid;
    covariance.noalias() += centred * centred.transpose();
  }
  covariance /= count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  fit.axes = solver.eigenvectors();
  fit.normal = fit.axes.col(0);
  fit.variances = solver.eigenvalues().cwiseMax(0.0);
  return fit;
}

}  // namespace regolith
