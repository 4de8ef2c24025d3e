// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/two_step_matcher.h"

#include "regolith/core/check.h"
#include "regolith/registration/robust_scale.h"

namespace regolith {
namespace {

constexpr size_t kChunkSize = 64;

/// One of the two steps: its features, where they are looked for, and the motions it determines.
struct Step {
  const std::vector<RingPoint>* edges = nullptr;
  const RingSearch* edge_target = nullptr;
  const std::vector<RingPoint>* planars = nullptr;
  const RingSearch* planar_target = nullptr;
  MotionSubspace subspace;
};

std::vector<Eigen::Vector3d> PositionsOf(const std::vector<RingPoint>* points) {
  std::vector<Eigen::Vector3d> positions;
  if (points == nullptr) return positions;
  positions.reserve(points->size());
  for (const RingPoint& point : *points) positions.push_back(point.position);
  return positions;
}

void Search(const Step& step, const SE3& T_last_current, double max_distance, ThreadPool* threads,
            FeatureMatches* matches) {
  threads->ParallelFor(matches->edges.size(), kChunkSize, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      matches->lines[i] =
          step.edge_target->FindLine(T_last_current * matches->edges[i], max_distance);
    }
  });
  threads->ParallelFor(matches->planars.size(), kChunkSize, [&](size_t begin, size_t end, size_t) {
    for (size_t i = begin; i < end; ++i) {
      matches->planes[i] =
          step.planar_target->FindPlane(T_last_current * matches->planars[i], max_distance);
    }
  });
}

/// Moves the pose within the step's subspace; false where too little was matched.
bool Solve(const Step& step, const TwoStepMatcherOptions& options, ThreadPool* threads,
           SE3* T_last_current) {
  FeatureMatches matches;
  matches.edges = PositionsOf(step.edges);
  matches.lines.resize(matches.edges.size());
  matches.planars = PositionsOf(step.planars);
  matches.planes.resize(matches.planars.size());
  for (int search = 0; search < options.max_searches; ++search) {
    Search(step, *T_last_current, options.max_distance, threads, &matches);
    const double kernel =
        kKernelSigmas * RobustScale(matches, *T_last_current, options.range_sigma);
    const FeatureSystem system = Linearize(matches, *T_last_current, kernel);
    if (system.matches < options.min_matches) return search > 0;
    int removed = 0;
    const MotionSubspace subspace =
        RemoveDegenerate(system, step.subspace, options.min_eigenvalue, &removed);
    const SE3 before = *T_last_current;
    *T_last_current =
        MinimizeDistances(matches, before, subspace, kernel, options.steps_per_search);
    if (HasConverged(before, *T_last_current, options.rotation_tolerance,
                     options.position_tolerance)) {
      break;
    }
  }
  return true;
}

}  // namespace

void TwoStepMatcherOptions::Check() const {
  REGOLITH_CHECK(max_distance > 0.0, "max_distance=", max_distance);
  REGOLITH_CHECK(max_searches > 0, "max_searches=", max_searches);
  REGOLITH_CHECK(steps_per_search > 0, "steps_per_search=", steps_per_search);
  REGOLITH_CHECK(range_sigma > 0.0, "range_sigma=", range_sigma);
  REGOLITH_CHECK(min_matches > 0, "min_matches=", min_matches);
  REGOLITH_CHECK(min_eigenvalue >= 0.0, "min_eigenvalue=", min_eigenvalue);
}

FeatureTarget::FeatureTarget(const ScanFeatures& features)
    : edges(features.edges), ground(features.ground_planars), clusters(features.cluster_planars) {}

TwoStepMatch MatchTwoStep(const ScanFeatures& current, const FeatureTarget& last,
                          const SE3& T_last_current_guess, const Eigen::Vector3d& up_lidar,
                          const TwoStepMatcherOptions& options, ThreadPool* threads) {
  const Eigen::Matrix3d along_up = up_lidar * up_lidar.transpose();
  const Eigen::Matrix3d across_up = Eigen::Matrix3d::Identity() - along_up;
  Step first;
  first.planars = &current.flat_planars;
  first.planar_target = &last.ground;
  first.subspace = {Matrix6d::Zero(), kTypicalRange};
  first.subspace.projection.topLeftCorner<3, 3>() = across_up;
  first.subspace.projection.bottomRightCorner<3, 3>() = along_up;

  Step second;
  second.edges = &current.sharp_edges;
  second.edge_target = &last.edges;
  second.planars = &current.cluster_planars;
  second.planar_target = &last.clusters;
  second.subspace = {Matrix6d::Identity() - first.subspace.projection, kTypicalRange};

  TwoStepMatch match;
  match.T_last_current = T_last_current_guess;
  match.used_ground = Solve(first, options, threads, &match.T_last_current);
  match.used_edges = Solve(second, options, threads, &match.T_last_current);
  return match;
}

}  // namespace regolith
