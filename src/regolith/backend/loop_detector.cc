// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/loop_detector.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

/// 1 σ of place (m) and turn (rad) on level ground.
struct Doubt {
  double position = 0.0;
  double yaw = 0.0;
};

Doubt DoubtOf(const UncertainPose& way, double inflation) {
  const Matrix6d& covariance = way.covariance;
  return {inflation * std::sqrt(covariance.bottomRightCorner<3, 3>().trace()),
          inflation * std::sqrt(covariance.topLeftCorner<3, 3>().trace())};
}

}  // namespace

const char* LoopSourceName(LoopSource source) {
  return source == LoopSource::kPosition ? "position" : "images";
}

size_t EndOfOld(const KeyframeStore& keyframes, const LoopSearchOptions& options) {
  const size_t newest = keyframes.size() - 1;
  size_t end = 0;
  while (end < newest &&
         SecondsBetween(keyframes[end].time, keyframes[newest].time) >= options.min_age &&
         keyframes[newest].way - keyframes[end].way >= options.min_way) {
    ++end;
  }
  return end;
}

std::vector<LoopCandidate> LoopDetector::Propose(const KeyframeStore& keyframes,
                                                 const FactorGraph& graph,
                                                 const OdometryChain& odometry,
                                                 double odometry_inflation,
                                                 std::optional<size_t> last_loop) const {
  std::vector<LoopCandidate> candidates;
  const size_t newest = keyframes.size() - 1;
  const SE3 T_newest_world = graph.pose(newest).Inverse();
  const size_t end = EndOfOld(keyframes, options_);
  for (size_t old = 0; old < end; ++old) {
    if (keyframes[old].points_body.empty()) continue;
    const SE3 T_newest_old = T_newest_world * graph.pose(old);
    const double distance = T_newest_old.translation.norm();
    if (distance > options_.max_distance + options_.max_doubt) continue;
    // Once a loop was closed, its keyframe stands well among the old ones.
    const size_t from = last_loop && *last_loop > old ? *last_loop : old;
    const Doubt doubt = DoubtOf(odometry.Between(from, newest), odometry_inflation);
    LoopCandidate candidate;
    candidate.old_keyframe = old;
    candidate.guess.T_target_query = T_newest_old.Inverse();
    candidate.guess.position_radius =
        std::min(options_.least_doubt + options_.sigmas * doubt.position, options_.max_doubt);
    candidate.guess.yaw_radius =
        std::min(options_.least_yaw_doubt + options_.sigmas * doubt.yaw, options_.max_yaw_doubt);
    const double reach =
        options_.max_distance + std::min(options_.sigmas * doubt.position, options_.max_doubt);
    if (distance > reach) continue;
    candidate.cost =
        distance / reach + PolarDistance(keyframes[old].descriptor, keyframes[newest].descriptor);
    candidates.push_back(candidate);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const LoopCandidate& a, const LoopCandidate& b) { return a.cost < b.cost; });
  if (candidates.size() > static_cast<size_t>(options_.max_candidates)) {
    candidates.resize(static_cast<size_t>(options_.max_candidates));
  }
  return candidates;
}

}  // namespace regolith
