// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/feature_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"
#include "regolith/registration/robust_scale.h"

namespace regolith {
namespace {

// Levenberg–Marquardt: damping at the start, and what a step that fails or succeeds does to it.
constexpr double kFirstDamping = 1e-3;
constexpr double kDampingUp = 10.0;
constexpr double kDampingDown = 0.3;

Eigen::Vector3d OffLine(const FeatureLine& line, const Eigen::Vector3d& point) {
  const Eigen::Vector3d offset = point - line.point;
  return offset - line.direction.dot(offset) * line.direction;
}

double OffPlane(const FeaturePlane& plane, const Eigen::Vector3d& point) {
  return plane.normal.dot(point - plane.point);
}

// ρ(d²) = d² / (1 + d² / k²), its weight ρ'.
double RobustCost(double squared, double kernel) {
  return squared / (1.0 + squared / (kernel * kernel));
}
double RobustWeight(double squared, double kernel) {
  const double root = 1.0 / (1.0 + squared / (kernel * kernel));
  return root * root;
}

// d (R Exp(φ) p + t + δ) = [-R Hat(p), I].
Eigen::Matrix<double, 3, 6> PointJacobian(const Eigen::Matrix3d& R_target_source,
                                          const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << -R_target_source * Hat(point), Eigen::Matrix3d::Identity();
  return jacobian;
}

void CheckSizes(const FeatureMatches& matches) {
  REGOLITH_CHECK(matches.edges.size() == matches.lines.size(), matches.edges.size(), " edges and ",
                 matches.lines.size(), " lines");
  REGOLITH_CHECK(matches.planars.size() == matches.planes.size(), matches.planars.size(),
                 " planars and ", matches.planes.size(), " planes");
}

double Cost(const FeatureMatches& matches, const SE3& T_target_source, double kernel) {
  double cost = 0.0;
  for (size_t i = 0; i < matches.edges.size(); ++i) {
    if (!matches.lines[i].valid) continue;
    const Eigen::Vector3d off = OffLine(matches.lines[i], T_target_source * matches.edges[i]);
    cost += 0.5 * RobustCost(off.squaredNorm(), kernel);
  }
  for (size_t i = 0; i < matches.planars.size(); ++i) {
    if (!matches.planes[i].valid) continue;
    const double off = OffPlane(matches.planes[i], T_target_source * matches.planars[i]);
    cost += 0.5 * RobustCost(off * off, kernel);
  }
  return cost;
}

// Turns a tangent vector of lengths into one of [rad, m].
Vector6d TangentScale(const MotionSubspace& subspace) {
  Vector6d scale = Vector6d::Ones();
  scale.head<3>().setConstant(1.0 / subspace.length);
  return scale;
}

// The information for tangent vectors of lengths, within the subspace; 0 outside.
Matrix6d Restrict(const Matrix6d& information, const MotionSubspace& subspace) {
  const Vector6d scale = TangentScale(subspace);
  const Matrix6d scaled = scale.asDiagonal() * information * scale.asDiagonal();
  return subspace.projection * scaled * subspace.projection;
}

Vector6d Step(const FeatureSystem& system, const MotionSubspace& subspace, double damping) {
  const Vector6d scale = TangentScale(subspace);
  Matrix6d normal = Restrict(system.information, subspace);
  normal.diagonal() *= 1.0 + damping;
  // Outside the subspace any positive number does: the gradient there is 0.
  normal += Matrix6d::Identity() - subspace.projection;
  normal.diagonal().array() += 1e-9;
  const Vector6d gradient = subspace.projection * scale.asDiagonal() * system.gradient;
  return -(scale.asDiagonal() * (subspace.projection * normal.ldlt().solve(gradient)));
}

}  // namespace

double RobustScale(const FeatureMatches& matches, const SE3& T_target_source, double floor) {
  CheckSizes(matches);
  std::vector<double> distances;
  for (size_t i = 0; i < matches.edges.size(); ++i) {
    if (!matches.lines[i].valid) continue;
    distances.push_back(OffLine(matches.lines[i], T_target_source * matches.edges[i]).norm());
  }
  for (size_t i = 0; i < matches.planars.size(); ++i) {
    if (!matches.planes[i].valid) continue;
    distances.push_back(
        std::abs(OffPlane(matches.planes[i], T_target_source * matches.planars[i])));
  }
  return RobustScale(std::move(distances), floor);
}

FeatureSystem Linearize(const FeatureMatches& matches, const SE3& T_target_source, double kernel) {
  CheckSizes(matches);
  const Eigen::Matrix3d R_target_source = T_target_source.rotation.toRotationMatrix();
  FeatureSystem system;
  system.cost = Cost(matches, T_target_source, kernel);
  for (size_t i = 0; i < matches.edges.size(); ++i) {
    const FeatureLine& line = matches.lines[i];
    if (!line.valid) continue;
    const Eigen::Vector3d off = OffLine(line, T_target_source * matches.edges[i]);
    const double weight = RobustWeight(off.squaredNorm(), kernel);
    const Eigen::Matrix<double, 3, 6> jacobian = PointJacobian(R_target_source, matches.edges[i]);
    const Vector6d along = jacobian.transpose() * line.direction;
    system.information.noalias() += weight * jacobian.transpose() * jacobian;
    system.information.noalias() -= weight * along * along.transpose();
    system.gradient.noalias() += weight * jacobian.transpose() * off;
    system.inliers += weight;
    ++system.matches;
  }
  for (size_t i = 0; i < matches.planars.size(); ++i) {
    const FeaturePlane& plane = matches.planes[i];
    if (!plane.valid) continue;
    const double off = OffPlane(plane, T_target_source * matches.planars[i]);
    const double weight = RobustWeight(off * off, kernel);
    Vector6d jacobian;
    jacobian << matches.planars[i].cross(R_target_source.transpose() * plane.normal), plane.normal;
    system.information.noalias() += weight * jacobian * jacobian.transpose();
    system.gradient.noalias() += weight * off * jacobian;
    system.inliers += weight;
    ++system.matches;
  }
  return system;
}

MotionSubspace RemoveDegenerate(const FeatureSystem& system, const MotionSubspace& subspace,
                                double min_eigenvalue, int* removed) {
  const Matrix6d information = Restrict(system.information, subspace);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(information);
  const double least = min_eigenvalue * std::max(system.inliers, 1.0);
  MotionSubspace kept{Matrix6d::Zero(), subspace.length};
  for (int i = 0; i < 6; ++i) {
    if (solver.eigenvalues()[i] < least) continue;
    const Vector6d direction = solver.eigenvectors().col(i);
    kept.projection.noalias() += direction * direction.transpose();
  }
  *removed = static_cast<int>(std::lround(subspace.projection.trace() - kept.projection.trace()));
  return kept;
}

SE3 MinimizeDistances(const FeatureMatches& matches, const SE3& T_target_source,
                      const MotionSubspace& subspace, double kernel, int steps) {
  SE3 best = T_target_source;
  FeatureSystem system = Linearize(matches, best, kernel);
  double damping = kFirstDamping;
  for (int step = 0; step < steps; ++step) {
    const SE3 moved = Plus(best, Step(system, subspace, damping));
    if (Cost(matches, moved, kernel) < system.cost) {
      best = moved;
      damping *= kDampingDown;
      if (step + 1 < steps) system = Linearize(matches, best, kernel);
    } else {
      damping *= kDampingUp;
    }
  }
  return best;
}

}  // namespace regolith
