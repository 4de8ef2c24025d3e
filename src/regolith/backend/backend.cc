// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/backend.h"

#include <algorithm>
#include <utility>

#include "regolith/core/check.h"

namespace regolith {

Backend::Backend(const BackendOptions& options, ThreadPool* threads)
    : options_(options),
      graph_(options.graph),
      keyframes_(options.keyframes, options.verifier.relief),
      detector_(options.search),
      verifier_(options.verifier, threads),
      consistency_(options.consistency) {
  options.Check();
}

std::vector<StageTime> Backend::Add(const KeyframeInput& input) {
  Stopwatch stopwatch;
  AddNode(input);
  stopwatch.Lap("keyframe");
  const bool found = options_.close_loops && FindLoops();
  stopwatch.Lap("loops");
  if (found) Update();
  if (options_.merge.enabled) MergeExplored();
  stopwatch.Lap("graph");
  return stopwatch.stages();
}

void Backend::AddNode(const KeyframeInput& input) {
  const size_t count = keyframes_.size();
  double way = 0.0;
  SE3 T_world_body = input.T_odom_body;
  Matrix6d step = Matrix6d::Zero();
  if (count > 0) {
    const SE3& T_odom_last = odometry_.T_odom_body(count - 1);
    const SE3 motion = T_odom_last.Inverse() * input.T_odom_body;
    step = StepCovariance(T_odom_last, last_covariance_, input.T_odom_body, input.covariance,
                          options_.keyframes.floor_rotation_sigma,
                          options_.keyframes.floor_position_sigma);
    T_world_body = graph_.pose(count - 1) * motion;
    way = keyframes_[count - 1].way + motion.translation.norm();
    graph_.AddNode(T_world_body);
    graph_.AddEdge({count - 1, count, {motion, step}, false});
  } else {
    graph_.AddNode(T_world_body);
    graph_.Hold(0);
  }
  if (input.is_level) {
    graph_.AddFactor(
        MakeGravityFactor(count, input.T_odom_body.rotation.conjugate() * Eigen::Vector3d::UnitZ(),
                          options_.keyframes.gravity_sigma));
  }
  odometry_.Append(input.T_odom_body, step);
  last_covariance_ = input.covariance;
  keyframes_.Append(input.time, way, input.points_body);
  keyframes_.DescribeNewest(graph_, odometry_);
}

bool Backend::FindLoops() {
  const size_t newest = keyframes_.size() - 1;
  const std::vector<LoopCandidate> candidates = detector_.Propose(
      keyframes_, graph_, odometry_, options_.consistency.odometry_inflation, last_loop_);
  if (candidates.empty()) return false;
  for (const LoopCandidate& candidate : candidates) {
    if (Verify(candidate, newest)) return true;
  }
  return false;
}

bool Backend::TryLoop(const LoopCandidate& candidate, size_t new_keyframe) {
  REGOLITH_CHECK(candidate.old_keyframe < new_keyframe && new_keyframe < keyframes_.size(), "loop ",
                 candidate.old_keyframe, " to ", new_keyframe, " of ", keyframes_.size());
  LoopCandidate standing = candidate;
  standing.old_keyframe = graph_.standing(candidate.old_keyframe);
  standing.guess.T_target_query =
      Between(standing.old_keyframe, candidate.old_keyframe) * candidate.guess.T_target_query;
  if (!Verify(standing, new_keyframe)) return false;
  Update();
  return true;
}

bool Backend::Verify(const LoopCandidate& candidate, size_t new_keyframe) {
  const size_t old = candidate.old_keyframe;
  LoopRecord record{old, new_keyframe, candidate.source, {}};
  record.verdict = verifier_.Verify(
      keyframes_.Submap(new_keyframe, old + 1, new_keyframe + 1, graph_, odometry_),
      keyframes_.Submap(old, 0, new_keyframe, graph_, odometry_), candidate.guess,
      graph_.pose(old).rotation);
  return Enter(std::move(record));
}

void Backend::AddLoop(const LoopMeasurement& loop) {
  REGOLITH_CHECK(loop.old_keyframe < loop.new_keyframe && loop.new_keyframe < keyframes_.size(),
                 "loop ", loop.old_keyframe, " to ", loop.new_keyframe, " of ", keyframes_.size());
  LoopRecord record{loop.old_keyframe, loop.new_keyframe, LoopSource::kImages, {}};
  record.verdict.outcome = LoopOutcome::kAccepted;
  record.verdict.T_target_query = loop.T_old_new;
  if (Enter(std::move(record))) Update();
}

bool Backend::Enter(LoopRecord record) {
  const LoopMeasurement loop{record.old_keyframe, record.new_keyframe,
                             record.verdict.T_target_query};
  const bool is_verified = record.verdict.outcome == LoopOutcome::kAccepted;
  const bool is_driven = is_verified && consistency_.AgreesWithOdometry(loop, odometry_);
  if (is_verified && !is_driven) record.verdict.outcome = LoopOutcome::kInconsistent;
  loops_.push_back(record);
  if (!is_driven) return false;
  consistency_.Add(loop, odometry_);
  confirmed_.push_back({loops_.size() - 1, std::nullopt, Confirms(loop), false});
  return true;
}

void Backend::Update() {
  if (UseAcceptedLoops()) graph_.Solve();
}

// A scan-to-map odometry on ground that it still has in its map has used it already, and more of it
// than a loop sees: where both agree within the loop's errors, the loop would add these alone. It
// holds the graph as it is then.
bool Backend::Confirms(const LoopMeasurement& loop) const {
  return SquaredDistance(loop.T_old_new,
                         {Between(loop.old_keyframe, loop.new_keyframe), Matrix6d::Zero()}) <=
         options_.consistency.confirming_squared_distance;
}

void Backend::Seal(ActiveLoop* loop) {
  loop->is_merged = true;
  loop->edge.reset();
}

bool Backend::UseAcceptedLoops() {
  bool changed = false;
  const std::vector<uint8_t>& accepted = consistency_.accepted();
  for (size_t i = 0; i < confirmed_.size(); ++i) {
    ActiveLoop& loop = confirmed_[i];
    if (loop.edge && !graph_.HasEdge(*loop.edge)) Seal(&loop);
    LoopRecord& record = loops_[loop.record];
    const bool is_used = accepted[i] != 0 || loop.confirms || loop.is_merged;
    record.verdict.outcome = is_used ? LoopOutcome::kAccepted : LoopOutcome::kUnsupported;
    if (is_used) last_loop_ = std::max(last_loop_.value_or(0), record.new_keyframe);
    if (loop.is_merged || is_used == loop.edge.has_value()) continue;
    changed = changed || !loop.confirms;
    if (is_used) {
      UncertainPose motion = record.verdict.T_target_query;
      if (loop.confirms) motion.T_a_b = Between(record.old_keyframe, record.new_keyframe);
      loop.edge = graph_.AddEdge({record.old_keyframe, record.new_keyframe, motion, true});
    } else {
      graph_.RemoveEdge(*loop.edge);
      loop.edge.reset();
    }
  }
  return changed;
}

void Backend::MergeExplored() {
  const size_t count = keyframes_.size();
  for (ActiveLoop& loop : confirmed_) {
    const LoopRecord& record = loops_[loop.record];
    const size_t node = record.new_keyframe;
    if (loop.edge && !graph_.HasEdge(*loop.edge)) Seal(&loop);
    if (!loop.edge || loop.is_merged || graph_.is_merged(node) ||
        node + static_cast<size_t>(options_.merge.delay) >= count) {
      continue;
    }
    if (record.verdict.T_target_query.T_a_b.translation.norm() > options_.merge.max_distance) {
      continue;
    }
    if (!graph_.Merge(node, *loop.edge)) continue;
    Seal(&loop);
    keyframes_.ForgetPoints(node);
  }
}

Trajectory Backend::Corrected(const Trajectory& odometry) const {
  Trajectory corrected;
  const size_t count = keyframes_.size();
  size_t next = 0;  // the first keyframe after the pose
  for (const StampedPose& pose : odometry.poses()) {
    while (next < count && keyframes_[next].time <= pose.time) ++next;
    const auto placed_by = [&](size_t keyframe) {
      return graph_.pose(keyframe) * odometry_.T_odom_body(keyframe).Inverse() * pose.T_world_body;
    };
    if (count == 0) {
      corrected.Append(pose);
    } else if (next == 0 || next == count) {
      corrected.Append({pose.time, placed_by(next == 0 ? 0 : count - 1)});
    } else {
      const double gap = SecondsBetween(keyframes_[next - 1].time, keyframes_[next].time);
      const double share = SecondsBetween(keyframes_[next - 1].time, pose.time) / gap;
      corrected.Append({pose.time, Interpolate(placed_by(next - 1), placed_by(next), share)});
    }
  }
  return corrected;
}

SE3 Backend::T_world_odom() const {
  const size_t count = keyframes_.size();
  if (count == 0) return SE3();
  return graph_.pose(count - 1) * odometry_.T_odom_body(count - 1).Inverse();
}

bool Backend::HasLoopAtNewest() const {
  return !confirmed_.empty() &&
         loops_[confirmed_.back().record].new_keyframe + 1 == keyframes_.size();
}

size_t Backend::loops_accepted() const {
  return static_cast<size_t>(std::count_if(
      loops_.begin(), loops_.end(),
      [](const LoopRecord& record) { return record.verdict.outcome == LoopOutcome::kAccepted; }));
}

}  // namespace regolith
