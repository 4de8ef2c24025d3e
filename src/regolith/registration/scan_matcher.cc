// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/registration/scan_matcher.h"

#include <Eigen/Cholesky>

#include "regolith/core/check.h"
#include "regolith/registration/robust_scale.h"

namespace regolith {

void ScanMatcherOptions::Check() const {
  planes.Check();
  REGOLITH_CHECK(max_searches >= 1, "max_searches=", max_searches);
  REGOLITH_CHECK(steps_per_search >= 1, "steps_per_search=", steps_per_search);
  REGOLITH_CHECK(min_matches >= 6, "min_matches=", min_matches);
  REGOLITH_CHECK(degenerate_ratio >= 1.0, "degenerate_ratio=", degenerate_ratio);
}

ScanMatch MatchScan(Span<const Eigen::Vector3d> points_body, const SE3& prior,
                    const Matrix6d& prior_covariance, Span<const VoxelMap> maps,
                    const ScanMatcherOptions& options, ThreadPool* threads) {
  ScanMatch match;
  match.T_map_body = prior;
  match.covariance = prior_covariance;
  const Matrix6d prior_information = prior_covariance.ldlt().solve(Matrix6d::Identity());
  Matrix6d information = prior_information;
  std::vector<PlaneMatch> planes;
  for (int search = 0; search < options.max_searches; ++search) {
    const SE3 before = match.T_map_body;
    FindPlanes(points_body, before, maps, options.planes, threads, &planes);
    match.searches = search + 1;
    for (int step = 0; step < options.steps_per_search; ++step) {
      match.system =
          LinearizePointToPlane(points_body, planes, match.T_map_body, options.planes, threads);
      if (match.system.matches < options.min_matches) {
        match.T_map_body = prior;
        match.observable.degenerate_directions = 6;
        return match;
      }
      match.observable = RemoveDegenerateDirections(match.system, options.degenerate_ratio);
      information = prior_information + match.observable.information;
      const Vector6d gradient =
          match.observable.gradient + prior_information * Minus(match.T_map_body, prior);
      match.T_map_body = Plus(match.T_map_body, -information.ldlt().solve(gradient));
    }
    if (HasConverged(before, match.T_map_body, options.rotation_tolerance,
                     options.position_tolerance)) {
      break;
    }
  }
  match.used_scan = true;
  match.covariance = information.ldlt().solve(Matrix6d::Identity());
  return match;
}

}  // namespace regolith
