// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/keyframe_graph.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {

void KeyframeGraphOptions::Check() const {
  REGOLITH_CHECK(distance > 0.0, "distance=", distance);
  REGOLITH_CHECK(angle > 0.0, "angle=", angle);
  REGOLITH_CHECK(search_radius > 0.0, "search_radius=", search_radius);
  REGOLITH_CHECK(min_age > 0.0, "min_age=", min_age);
  REGOLITH_CHECK(interval > 0, "interval=", interval);
  REGOLITH_CHECK(submap_keyframes >= 0, "submap_keyframes=", submap_keyframes);
  REGOLITH_CHECK(min_overlap > 0.0 && min_overlap <= 1.0, "min_overlap=", min_overlap);
  REGOLITH_CHECK(max_scale > 0.0, "max_scale=", max_scale);
  REGOLITH_CHECK(max_correction > 0.0, "max_correction=", max_correction);
  for (const double sigma :
       {step_rotation_sigma, step_position_sigma, loop_rotation_sigma, loop_position_sigma}) {
    REGOLITH_CHECK(sigma > 0.0, "sigma=", sigma);
  }
}

KeyframeGraph::KeyframeGraph(const KeyframeGraphOptions& options, const FeatureMapOptions& map)
    : options_(options), map_(map) {
  options.Check();
}

bool KeyframeGraph::IsNew(const SE3& T_map_lidar) const {
  if (keyframes_.empty()) return true;
  const SE3 moved = keyframes_.back().T_map_lidar.Inverse() * T_map_lidar;
  return moved.translation.norm() > options_.distance ||
         LogSo3(moved.rotation).norm() > options_.angle;
}

void KeyframeGraph::Add(Keyframe keyframe) {
  if (!keyframes_.empty()) {
    PoseGraphEdge edge;
    edge.from = keyframes_.size() - 1;
    edge.to = keyframes_.size();
    edge.T_from_to = keyframes_.back().T_map_lidar.Inverse() * keyframe.T_map_lidar;
    edge.rotation_sigma = options_.step_rotation_sigma;
    edge.position_sigma = options_.step_position_sigma;
    edges_.push_back(edge);
  }
  keyframes_.push_back(std::move(keyframe));
}

std::optional<size_t> KeyframeGraph::FindOld() const {
  const Keyframe& newest = keyframes_.back();
  double nearest = options_.search_radius;
  std::optional<size_t> old;
  for (size_t i = 0; i < keyframes_.size(); ++i) {
    if (SecondsBetween(keyframes_[i].time, newest.time) < options_.min_age) break;
    const double distance =
        (keyframes_[i].T_map_lidar.translation - newest.T_map_lidar.translation).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    old = i;
  }
  return old;
}

std::optional<SE3> KeyframeGraph::MatchOld(size_t old, ThreadPool* threads) const {
  const Keyframe& newest = keyframes_.back();
  const auto reach = static_cast<size_t>(options_.submap_keyframes);
  FeatureMap submap(map_);
  for (size_t i = old < reach ? 0 : old - reach; i <= old + reach && i < keyframes_.size(); ++i) {
    // Young keyframes would tie the newest to where it already is.
    if (SecondsBetween(keyframes_[i].time, newest.time) < options_.min_age) break;
    submap.Add(keyframes_[i].cloud, keyframes_[i].T_map_lidar);
  }
  const MapMatch match = submap.Match(newest.cloud, newest.T_map_lidar, threads);
  const auto features =
      static_cast<double>(newest.cloud.edges.size() + newest.cloud.planars.size());
  const double correction = (match.T_map_lidar.translation - newest.T_map_lidar.translation).norm();
  const bool is_good = match.used_scan && match.degenerate_directions == 0 &&
                       match.scale <= options_.max_scale && correction <= options_.max_correction &&
                       match.system.matches >= options_.min_overlap * features;
  if (!is_good) return std::nullopt;
  return match.T_map_lidar;
}

bool KeyframeGraph::CloseLoop(ThreadPool* threads) {
  if (!options_.close_loops || keyframes_.empty()) return false;
  const size_t newest = keyframes_.size() - 1;
  if (newest - last_attempt_ < static_cast<size_t>(options_.interval)) return false;
  const std::optional<size_t> old = FindOld();
  if (!old) return false;
  last_attempt_ = newest;
  const std::optional<SE3> T_map_newest = MatchOld(*old, threads);
  if (!T_map_newest) {
    ++loops_rejected_;
    return false;
  }
  ++loops_accepted_;
  PoseGraphEdge loop;
  loop.from = *old;
  loop.to = newest;
  loop.T_from_to = keyframes_[*old].T_map_lidar.Inverse() * *T_map_newest;
  loop.rotation_sigma = options_.loop_rotation_sigma;
  loop.position_sigma = options_.loop_position_sigma;
  loop.robust = true;
  edges_.push_back(loop);

  std::vector<SE3> poses;
  for (const Keyframe& keyframe : keyframes_) poses.push_back(keyframe.T_map_lidar);
  poses = OptimizePoseGraph(poses, edges_);
  for (size_t i = 0; i < poses.size(); ++i) keyframes_[i].T_map_lidar = poses[i];
  return true;
}

}  // namespace regolith
