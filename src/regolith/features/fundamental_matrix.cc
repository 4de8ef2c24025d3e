// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/fundamental_matrix.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace regolith {
namespace {

constexpr int kIterations = 8;

using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Vector9d = Eigen::Matrix<double, 9, 1>;

/// Moves the points' mean to 0 and their mean distance from it to about 1, without which the
/// squares of pixels drown the rest (Hartley 1997).
Eigen::Matrix3d Normalisation(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  double spread = 0.0;
  for (const Eigen::Vector2d& point : points) spread += (point - mean).norm();
  const double scale = static_cast<double>(points.size()) / std::max(spread, 1e-6);
  Eigen::Matrix3d result;
  result << scale, 0.0, -scale * mean.x(), 0.0, scale, -scale * mean.y(), 0.0, 0.0, 1.0;
  return result;
}

/// Sum of Geman and McClure's losses, each below 1.
double Cost(const std::vector<Eigen::Vector2d>& first, const std::vector<Eigen::Vector2d>& second,
            const Eigen::Matrix3d& F_second_first, double square_width) {
  double cost = 0.0;
  for (size_t i = 0; i < first.size(); ++i) {
    const double square = SquareLineDistance(F_second_first, first[i], second[i]);
    cost += square / (square + square_width);
  }
  return cost;
}

Eigen::Matrix3d WithRankTwo(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d values = svd.singularValues();
  values[2] = 0.0;
  return svd.matrixU() * values.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

double SquareLineDistance(const Eigen::Matrix3d& F_second_first, const Eigen::Vector2d& first,
                          const Eigen::Vector2d& second) {
  const Eigen::Vector3d line_second = F_second_first * first.homogeneous();
  const Eigen::Vector3d line_first = F_second_first.transpose() * second.homogeneous();
  const double product = line_second.dot(second.homogeneous());
  const double square_norm =
      0.5 * (line_second.head<2>().squaredNorm() + line_first.head<2>().squaredNorm());
  return product * product / std::max(square_norm, 1e-300);
}

Eigen::Matrix3d RefineFundamental(const std::vector<Eigen::Vector2d>& first,
                                  const std::vector<Eigen::Vector2d>& second,
                                  const Eigen::Matrix3d& initial, double threshold) {
  const Eigen::Matrix3d normalise_first = Normalisation(first);
  const Eigen::Matrix3d normalise_second = Normalisation(second);
  const double square_width = threshold * threshold;
  Eigen::Matrix3d best = initial;
  double best_cost = Cost(first, second, initial, square_width);
  Eigen::Matrix3d current = initial;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Matrix9d normal = Matrix9d::Zero();
    for (size_t i = 0; i < first.size(); ++i) {
      const Eigen::Vector3d line_second = current * first[i].homogeneous();
      const Eigen::Vector3d line_first = current.transpose() * second[i].homogeneous();
      const double square_norm =
          line_second.head<2>().squaredNorm() + line_first.head<2>().squaredNorm();
      const double relative = 1.0 + SquareLineDistance(current, first[i], second[i]) / square_width;
      const double weight = 1.0 / (relative * relative * std::max(square_norm, 1e-300));
      const Eigen::Vector3d x = normalise_first * first[i].homogeneous();
      const Eigen::Vector3d y = normalise_second * second[i].homogeneous();
      Vector9d terms;
      terms << x * y.x(), x * y.y(), x * y.z();
      normal.selfadjointView<Eigen::Lower>().rankUpdate(terms, weight);
    }
    const Eigen::SelfAdjointEigenSolver<Matrix9d> solver(normal / normal.trace());
    const Vector9d solution = solver.eigenvectors().col(0);
    Eigen::Matrix3d matrix;
    matrix << solution.segment<3>(0).transpose(), solution.segment<3>(3).transpose(),
        solution.segment<3>(6).transpose();
    current = normalise_second.transpose() * WithRankTwo(matrix) * normalise_first;
    current /= current.norm();
    const double cost = Cost(first, second, current, square_width);
    if (!(cost < best_cost)) break;
    best = current;
    best_cost = cost;
  }
  return best;
}

}  // namespace regolith
