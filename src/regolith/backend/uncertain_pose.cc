// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/uncertain_pose.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace regolith {
namespace {

constexpr double kLeastInformation = 1.0 / kUnknownVariance;
constexpr double kLeastVariance = 1e-14;  // rad² or m²

Matrix6d RotatedPosition(const Eigen::Matrix3d& rotation) {
  Matrix6d matrix = Matrix6d::Identity();
  matrix.bottomRightCorner<3, 3>() = rotation;
  return matrix;
}

template <typename Map>
Matrix6d MapEigenvalues(const Matrix6d& symmetric, const Map& map) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(0.5 * (symmetric + symmetric.transpose()));
  Vector6d values;
  for (int i = 0; i < 6; ++i) values[i] = map(solver.eigenvalues()[i]);
  return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

UncertainPose Compose(const UncertainPose& a_b, const UncertainPose& b_c) {
  // T_ab Exp(ξ) T_bc = T_ab T_bc Exp(Ad(T_bc⁻¹) ξ).
  const Matrix6d adjoint = AdjointSe3(b_c.T_a_b.Inverse());
  return {a_b.T_a_b * b_c.T_a_b, adjoint * a_b.covariance * adjoint.transpose() + b_c.covariance};
}

UncertainPose Inverse(const UncertainPose& a_b) {
  const Matrix6d adjoint = AdjointSe3(a_b.T_a_b);
  return {a_b.T_a_b.Inverse(), adjoint * a_b.covariance * adjoint.transpose()};
}

UncertainPose Fuse(const UncertainPose& first, const UncertainPose& second) {
  const Matrix6d first_information = InformationOf(first.covariance);
  const Matrix6d second_information = InformationOf(second.covariance);
  Matrix6d information = first_information + second_information;
  const Vector6d difference = LogSe3(first.T_a_b.Inverse() * second.T_a_b);
  const Matrix6d covariance = CovarianceOf(information);
  return {first.T_a_b * ExpSe3(covariance * (second_information * difference)), covariance};
}

Matrix6d PlusToExpCovariance(const Matrix6d& covariance, const SE3& pose) {
  const Matrix6d turn = RotatedPosition(pose.rotation.conjugate().toRotationMatrix());
  return turn * covariance * turn.transpose();
}

Matrix6d ExpToPlusCovariance(const Matrix6d& covariance, const SE3& pose) {
  const Matrix6d turn = RotatedPosition(pose.rotation.toRotationMatrix());
  return turn * covariance * turn.transpose();
}

Matrix6d CovarianceOf(const Matrix6d& information) {
  return MapEigenvalues(information, [](double value) {
    return value > kLeastInformation ? 1.0 / value : kUnknownVariance;
  });
}

Matrix6d InformationOf(const Matrix6d& covariance) {
  return MapEigenvalues(covariance, [](double value) {
    return value < 0.99 * kUnknownVariance ? 1.0 / std::max(value, kLeastVariance) : 0.0;
  });
}

Matrix6d SquareRootOf(const Matrix6d& information) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(0.5 *
                                                       (information + information.transpose()));
  const Vector6d roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return roots.asDiagonal() * solver.eigenvectors().transpose();
}

double SquaredDistance(const UncertainPose& first, const UncertainPose& second) {
  const Vector6d difference = LogSe3(first.T_a_b.Inverse() * second.T_a_b);
  const Matrix6d covariance = first.covariance + second.covariance;
  return difference.dot(covariance.ldlt().solve(difference));
}

}  // namespace regolith
