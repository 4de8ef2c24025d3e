// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/scan_matcher.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace regolith {
namespace {

// Position's share of the information once rotation is free (Schur complement), by eigenvalue.
int CountDegenerateDirections(const Matrix6d& information, double sigma) {
  Eigen::Matrix3d rotation = information.topLeftCorner<3, 3>();
  rotation.diagonal().array() += 1e-9;
  const Eigen::Matrix3d coupling = information.topRightCorner<3, 3>();
  const Eigen::Matrix3d position = information.bottomRightCorner<3, 3>() -
                                   coupling.transpose() * rotation.ldlt().solve(coupling);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(position, Eigen::EigenvaluesOnly);
  return static_cast<int>((solver.eigenvalues().array() < 1.0 / (sigma * sigma)).count());
}

}  // namespace

ScanMatch MatchScan(Span<const Eigen::Vector3d> points_body, const SE3& prior,
                    const Matrix6d& prior_covariance, Span<const VoxelMap> maps,
                    const ScanMatcherOptions& options, ThreadPool* threads) {
  ScanMatch match;
  match.T_map_body = prior;
  match.covariance = prior_covariance;
  const Matrix6d prior_information = prior_covariance.ldlt().solve(Matrix6d::Identity());
  Matrix6d information = prior_information;
  for (int search = 0; search < options.max_searches; ++search) {
    const SE3 before = match.T_map_body;
    const auto planes = FindPlanes(points_body, before, maps, options.planes, threads);
    match.searches = search + 1;
    for (int step = 0; step < options.steps_per_search; ++step) {
      match.system = LinearizePointToPlane(points_body, planes, match.T_map_body, options.planes);
      if (match.system.matches < options.min_matches) {
        match.T_map_body = prior;
        match.degenerate_directions = 3;
        return match;
      }
      information = prior_information + match.system.information;
      const Vector6d gradient =
          match.system.gradient + prior_information * Minus(match.T_map_body, prior);
      match.T_map_body = Plus(match.T_map_body, -information.ldlt().solve(gradient));
    }
    const Vector6d change = Minus(match.T_map_body, before);
    if (change.head<3>().norm() < options.rotation_tolerance &&
        change.tail<3>().norm() < options.position_tolerance) {
      break;
    }
  }
  match.used_scan = true;
  match.covariance = information.ldlt().solve(Matrix6d::Identity());
  match.degenerate_directions =
      CountDegenerateDirections(match.system.information, options.degenerate_sigma);
  return match;
}

}  // namespace regolith
