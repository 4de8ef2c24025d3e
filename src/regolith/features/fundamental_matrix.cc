// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/fundamental_matrix.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr int kSamples = 30;
// Not minimal: what noise a fit of few has, a fit of many has less of.
constexpr size_t kSampleSize = 50;
constexpr int kIterations = 10;
// Of the trace. Points of a plane leave directions open; there the matrix has to stay.
constexpr double kMinDamping = 1e-8;
constexpr double kMaxDamping = 1.0;

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

struct Problem {
  const std::vector<Eigen::Vector2d>& first;
  const std::vector<Eigen::Vector2d>& second;
  Eigen::Matrix3d normalise_first;
  Eigen::Matrix3d normalise_second;
  double square_width = 0.0;  ///< pixels squared, of the loss
};

/// Sum of Geman and McClure's losses, each below 1. Gives up when above `limit`.
double Cost(const Problem& problem, const Eigen::Matrix3d& F_second_first, double limit) {
  double cost = 0.0;
  for (size_t i = 0; i < problem.first.size() && cost < limit; ++i) {
    const double square = SquareLineDistance(F_second_first, problem.first[i], problem.second[i]);
    cost += square / (square + problem.square_width);
  }
  return cost;
}

/// v of v . F = 0, F row by row, all in normalised coordinates.
Vector9d Terms(const Problem& problem, size_t index) {
  const Eigen::Vector3d x = problem.normalise_first * problem.first[index].homogeneous();
  const Eigen::Vector3d y = problem.normalise_second * problem.second[index].homogeneous();
  Vector9d terms;
  terms << y.x() * x, y.y() * x, y.z() * x;
  return terms;
}

/// Sum of weight * v v^T over all points.
Matrix9d NormalEquations(const Problem& problem, const Eigen::Matrix3d& F_second_first) {
  Matrix9d normal = Matrix9d::Zero();
  for (size_t i = 0; i < problem.first.size(); ++i) {
    const Eigen::Vector3d line_second = F_second_first * problem.first[i].homogeneous();
    const Eigen::Vector3d line_first = F_second_first.transpose() * problem.second[i].homogeneous();
    const double square_norm = std::max(
        0.5 * (line_second.head<2>().squaredNorm() + line_first.head<2>().squaredNorm()), 1e-300);
    const double product = line_second.dot(problem.second[i].homogeneous());
    const double relative = 1.0 + product * product / square_norm / problem.square_width;
    if (relative > 10.0) continue;  // of a weight below a hundredth
    const Vector9d terms = Terms(problem, i);
    normal.noalias() += (terms / (relative * relative * square_norm)) * terms.transpose();
  }
  return normal;
}

Vector9d Flatten(const Eigen::Matrix3d& matrix) {
  Vector9d result;
  result << matrix.row(0).transpose(), matrix.row(1).transpose(), matrix.row(2).transpose();
  return result;
}

/// The nearest matrix of rank two, of length one.
Eigen::Matrix3d WithRankTwo(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d values = svd.singularValues();
  values[2] = 0.0;
  return svd.matrixU() * (values.normalized().asDiagonal() * svd.matrixV().transpose());
}

/// One step of Levenberg and Marquardt among matrices of rank two and length one.
Eigen::Matrix3d Step(const Eigen::Matrix3d& current, const Matrix9d& normal, double damping) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(current, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d& U = svd.matrixU();
  const Eigen::Matrix3d& V = svd.matrixV();
  const Eigen::Vector3d values = svd.singularValues();
  // The seven directions: U and V turn about three axes each, and the singular values against
  // each other.
  Eigen::Matrix<double, 9, 7> tangent;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
    turn((axis + 1) % 3, (axis + 2) % 3) = -1.0;
    turn((axis + 2) % 3, (axis + 1) % 3) = 1.0;
    const Eigen::Vector3d rank_two(values[0], values[1], 0.0);
    tangent.col(axis) = Flatten(U * turn * rank_two.asDiagonal() * V.transpose());
    tangent.col(axis + 3) = Flatten(U * rank_two.asDiagonal() * turn * V.transpose());
  }
  const Eigen::Vector3d exchange(-values[1], values[0], 0.0);
  tangent.col(6) = Flatten(U * exchange.asDiagonal() * V.transpose());
  Eigen::Matrix<double, 7, 7> system = tangent.transpose() * normal * tangent;
  system.diagonal().array() += damping * system.trace();
  const Vector9d step =
      tangent * system.ldlt().solve(-tangent.transpose() * (normal * Flatten(current)));
  Eigen::Matrix3d moved = current;
  for (int row = 0; row < 3; ++row) moved.row(row) += step.segment<3>(3 * row).transpose();
  return WithRankTwo(moved);
}

/// The matrix that fits a few points drawn from `rows` best (the eight-point algorithm).
Eigen::Matrix3d FitSample(const Problem& problem, const std::vector<size_t>& rows, Random* random) {
  Matrix9d normal = Matrix9d::Zero();
  for (size_t i = 0; i < kSampleSize; ++i) {
    const Vector9d terms = Terms(problem, rows[random->Next() % rows.size()]);
    normal.noalias() += terms * terms.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix9d> solver(normal);
  const Vector9d solution = solver.eigenvectors().col(0);
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row) matrix.row(row) = solution.segment<3>(3 * row).transpose();
  return problem.normalise_second.transpose() * WithRankTwo(matrix) * problem.normalise_first;
}

/// Goes down to the bottom of the valley.
Eigen::Matrix3d Polish(const Problem& problem, Eigen::Matrix3d best, double best_cost) {
  const Eigen::Matrix3d back_first = problem.normalise_first.inverse();
  const Eigen::Matrix3d back_second = problem.normalise_second.inverse();
  double damping = kMinDamping;
  Matrix9d normal = NormalEquations(problem, best);
  for (int iteration = 0; iteration < kIterations && damping < kMaxDamping; ++iteration) {
    const Eigen::Matrix3d normalised = (back_second.transpose() * best * back_first).normalized();
    const Eigen::Matrix3d next = problem.normalise_second.transpose() *
                                 Step(normalised, normal, damping) * problem.normalise_first;
    const double cost = Cost(problem, next, best_cost);
    if (!(cost < best_cost)) {
      damping *= 30.0;
      continue;
    }
    const bool converged = cost > best_cost - 0.1;  // a tenth of one match
    best = next;
    best_cost = cost;
    if (converged) break;
    damping = std::max(kMinDamping, damping / 10.0);
    normal = NormalEquations(problem, best);
  }
  return best;
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
  const Problem problem{first, second, Normalisation(first), Normalisation(second),
                        threshold * threshold};
  // A rough matrix often lies in another valley than the best one; fits of few of its inliers lie
  // all around (Chum et al. 2003).
  std::vector<size_t> inliers;
  for (size_t i = 0; i < first.size(); ++i) {
    if (SquareLineDistance(initial, first[i], second[i]) <= 4.0 * problem.square_width) {
      inliers.push_back(i);
    }
  }
  Eigen::Matrix3d best = initial;
  double best_cost = Cost(problem, initial, INFINITY);
  Random random(0x7265676fULL, "fundamental matrix");
  for (int i = 0; i < kSamples && inliers.size() > kSampleSize; ++i) {
    const Eigen::Matrix3d sampled = FitSample(problem, inliers, &random);
    const double cost = Cost(problem, sampled, best_cost);
    if (!(cost < best_cost)) continue;
    best = sampled;
    best_cost = cost;
  }
  return Polish(problem, best, best_cost);
}

}  // namespace regolith
