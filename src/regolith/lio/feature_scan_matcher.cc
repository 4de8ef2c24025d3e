// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/feature_scan_matcher.h"

#include <Eigen/Cholesky>

#include "regolith/cloud/downsample.h"
#include "regolith/core/check.h"
#include "regolith/lio/curvature_features.h"

namespace regolith {
namespace {

std::vector<Eigen::Vector3d> Thinned(const std::vector<Eigen::Vector3d>& points,
                                     const std::vector<uint32_t>& chosen, double spacing) {
  std::vector<Eigen::Vector3d> all;
  all.reserve(chosen.size());
  for (const uint32_t index : chosen) all.push_back(points[index]);
  std::vector<Eigen::Vector3d> kept;
  for (const uint32_t index : DownsampleIndices(all, spacing)) kept.push_back(all[index]);
  return kept;
}

}  // namespace

void FeatureScanMatcherOptions::Check() const {
  curvature.Check();
  map.Check();
  REGOLITH_CHECK(independence > 0.0 && independence <= 1.0, "independence=", independence);
}

FeatureScanMatcher::FeatureScanMatcher(const FeatureScanMatcherOptions& options, int rings)
    : options_(options), rings_(rings), map_(options.map) {
  options.Check();
}

ScanMatch FeatureScanMatcher::Match(const LidarScan& scan,
                                    const std::vector<Eigen::Vector3d>& points_body,
                                    const SE3& prior, const Matrix6d& prior_covariance,
                                    ThreadPool* threads) {
  const CurvatureFeatures features = ExtractCurvatureFeatures(scan, rings_, options_.curvature);
  cloud_body_.edges = Thinned(points_body, features.edges, options_.map.edge_spacing);
  cloud_body_.planars = Thinned(points_body, features.planars, options_.map.planar_spacing);

  ScanMatch match;
  match.T_map_body = prior;
  match.covariance = prior_covariance;
  match.system.points = static_cast<int>(cloud_body_.edges.size() + cloud_body_.planars.size());
  match.observable.degenerate_directions = 6;
  if (map_.empty()) return match;
  const MapMatch found = map_.Match(cloud_body_, prior, threads);
  match.system.matches = found.system.matches;
  match.system.inliers = found.system.inliers;
  match.system.scale = found.scale;
  if (!found.used_scan) return match;
  match.used_scan = true;
  match.observable.degenerate_directions = found.degenerate_directions;
  match.observable.information =
      options_.independence / (found.scale * found.scale) * found.system.information;
  const Matrix6d information =
      prior_covariance.ldlt().solve(Matrix6d::Identity()) + match.observable.information;
  const Vector6d correction = match.observable.information * Minus(found.T_map_lidar, prior);
  match.T_map_body = Plus(prior, information.ldlt().solve(correction));
  match.covariance = information.ldlt().solve(Matrix6d::Identity());
  return match;
}

void FeatureScanMatcher::Extend(const SE3& T_map_body) {
  map_.Add(cloud_body_, T_map_body);
  map_.ForgetFarFrom(T_map_body.translation);
}

}  // namespace regolith
