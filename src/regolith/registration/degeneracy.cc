// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/degeneracy.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "regolith/core/check.h"

namespace regolith {
namespace {

// Keeps the noise regular where the normals are exact; ratios are bounded by its inverse.
constexpr double kLeastNoise = 1e-3;
constexpr double kTiny = 1e-9;

}  // namespace

ObservableSystem RemoveDegenerateDirections(const PointToPlaneSystem& system, double min_ratio) {
  REGOLITH_CHECK(min_ratio >= 1.0, "min_ratio=", min_ratio);
  Matrix6d noise = system.noise + kLeastNoise * system.information;
  noise.diagonal().array() += kTiny;
  const Eigen::LLT<Matrix6d> root(noise);
  const Matrix6d half = root.matrixL().solve(system.information);
  const Matrix6d whitened = root.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(whitened);

  ObservableSystem observable;
  Vector6d kept = Vector6d::Zero();
  for (int i = 0; i < 6; ++i) {
    const double ratio = solver.eigenvalues()[i];
    if (ratio < min_ratio) {
      ++observable.degenerate_directions;
    } else {
      kept[i] = 1.0 - 1.0 / ratio;
    }
  }
  const Matrix6d basis = root.matrixL() * solver.eigenvectors();
  const Vector6d values = kept.cwiseProduct(solver.eigenvalues());
  observable.information = basis * values.asDiagonal() * basis.transpose();
  const Vector6d gradient =
      solver.eigenvectors().transpose() * root.matrixL().solve(system.gradient);
  observable.gradient = basis * kept.cwiseProduct(gradient);

  observable.weakest_ratio = solver.eigenvalues()[0];
  const Vector6d weakest = root.matrixU().solve(solver.eigenvectors().col(0));
  const double length = weakest.tail<3>().norm();
  if (length > 0.0) observable.weakest_position = weakest.tail<3>() / length;
  return observable;
}

Matrix6d ObservedCovariance(const ObservableSystem& system) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(system.information);
  // Eigenvalues are ascending, so the degenerate directions come first.
  Vector6d variances = Vector6d::Zero();
  for (int i = system.degenerate_directions; i < 6; ++i) {
    variances[i] = 1.0 / solver.eigenvalues()[i];
  }
  return solver.eigenvectors() * variances.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace regolith
