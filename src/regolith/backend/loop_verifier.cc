// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/loop_verifier.h"

#include <algorithm>
#include <cmath>

#include "regolith/cloud/downsample.h"
#include "regolith/cloud/voxel_map.h"
#include "regolith/geometry/so3.h"
#include "regolith/registration/scan_matcher.h"

namespace regolith {
namespace {

constexpr double kMapGrowth = 3.0;      // of the coarser map's voxels
constexpr int kSubmapVoxels = 40000;    // at most
constexpr double kSubmapRadius = 60.0;  // m
// What the best offset leaves open: 1 σ of the prior of registration.
constexpr double kPriorRotation = 0.05;  // rad
constexpr double kPriorPosition = 0.5;   // m

std::vector<Eigen::Vector3d> Transformed(const SE3& transform, Span<const Eigen::Vector3d> points) {
  std::vector<Eigen::Vector3d> moved(points.size());
  for (size_t i = 0; i < points.size(); ++i) moved[i] = transform * points[i];
  return moved;
}

Matrix6d Diagonal(double rotation_sigma, double position_sigma) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma),
      Eigen::Vector3d::Constant(position_sigma * position_sigma);
  return variances.asDiagonal();
}

std::vector<VoxelMap> MapsOf(Span<const Eigen::Vector3d> points, double voxel_size) {
  std::vector<VoxelMap> maps;
  VoxelMapOptions options;
  options.radius = kSubmapRadius;
  options.max_voxels = kSubmapVoxels;
  for (const double size : {voxel_size, kMapGrowth * voxel_size}) {
    options.voxel_size = size;
    maps.emplace_back(options);
    maps.back().Add(points, Eigen::Vector3d::Zero());
  }
  return maps;
}

std::vector<Eigen::Vector3d> Thinned(Span<const Eigen::Vector3d> points, double spacing, int most) {
  const std::vector<uint32_t> kept = DownsampleIndices(points, spacing);
  const size_t count = std::min(kept.size(), static_cast<size_t>(most));
  std::vector<Eigen::Vector3d> thinned(count);
  for (size_t i = 0; i < count; ++i) thinned[i] = points[kept[i * kept.size() / count]];
  return thinned;
}

}  // namespace

const char* LoopOutcomeName(LoopOutcome outcome) {
  switch (outcome) {
    case LoopOutcome::kAccepted:
      return "accepted";
    case LoopOutcome::kTooLittleOverlap:
      return "too little overlap";
    case LoopOutcome::kOtherGround:
      return "other ground";
    case LoopOutcome::kAmbiguous:
      return "ambiguous";
    case LoopOutcome::kNotAligned:
      return "not aligned";
    case LoopOutcome::kDegenerate:
      return "degenerate";
    case LoopOutcome::kPoorFit:
      return "poor fit";
    case LoopOutcome::kInconsistent:
      return "inconsistent";
    case LoopOutcome::kUnsupported:
      return "unsupported";
  }
  return "";
}

LoopVerifier::LoopVerifier(const LoopVerifierOptions& options, ThreadPool* threads)
    : options_(options), threads_(threads) {
  options.Check();
}

LoopVerdict LoopVerifier::Verify(Span<const Eigen::Vector3d> query,
                                 Span<const Eigen::Vector3d> target, const LoopGuess& guess,
                                 const Eigen::Quaterniond& R_level_target) const {
  LoopVerdict verdict;
  const SE3 T_level_target(R_level_target, Eigen::Vector3d::Zero());
  const ReliefImage target_relief(Transformed(T_level_target, target), options_.relief);
  // The query about its own place, in axes of the level frame as guessed.
  const SE3 T_axes_query(R_level_target * guess.T_target_query.rotation, Eigen::Vector3d::Zero());
  const ReliefImage query_relief(Transformed(T_axes_query, query), options_.relief);
  const Eigen::Vector3d place = T_level_target * guess.T_target_query.translation;
  ReliefSearch search;
  search.centre = place.head<2>();
  search.radius = guess.position_radius;
  search.yaw_radius = guess.yaw_radius;
  verdict.relief = MatchRelief(query_relief.cells(), target_relief, search, options_, threads_);

  const ReliefMatch& relief = verdict.relief;
  if (!relief.found) return verdict;
  verdict.outcome = LoopOutcome::kOtherGround;
  if (relief.agreement < options_.try_agreement) return verdict;
  const SE3 T_level_query(
      ExpSo3({0.0, 0.0, relief.yaw}) * T_axes_query.rotation,
      {place.x() + relief.offset.x(), place.y() + relief.offset.y(), relief.height});
  if (!Register(query, target, T_level_target.Inverse() * T_level_query, &verdict)) return verdict;

  const SE3 T_level_axes = T_level_target * verdict.T_target_query.T_a_b * T_axes_query.Inverse();
  verdict.agreement =
      AgreementAt(query_relief.cells(), target_relief, T_level_axes, options_.relief.min_cells);
  if (verdict.agreement < options_.min_agreement) {
    verdict.outcome = LoopOutcome::kOtherGround;
  } else if (1.0 - verdict.agreement > options_.max_ambiguity * (1.0 - relief.runner_up)) {
    verdict.outcome = LoopOutcome::kAmbiguous;
  } else {
    verdict.outcome = LoopOutcome::kAccepted;
  }
  return verdict;
}

bool LoopVerifier::Register(Span<const Eigen::Vector3d> query, Span<const Eigen::Vector3d> target,
                            const SE3& T_target_query, LoopVerdict* verdict) const {
  const std::vector<Eigen::Vector3d> points =
      Thinned(query, options_.point_spacing, options_.max_points);
  const std::vector<VoxelMap> maps = MapsOf(target, options_.voxel_size);
  const ScanMatch match =
      MatchScan(points, T_target_query, Diagonal(kPriorRotation, kPriorPosition), maps,
                options_.matcher, threads_);
  verdict->matches = static_cast<double>(match.system.matches) / match.system.points;
  verdict->scale = match.system.scale;
  const SE3 correction = T_target_query.Inverse() * match.T_map_body;
  verdict->outcome = LoopOutcome::kNotAligned;
  if (!match.used_scan || correction.translation.norm() > options_.max_correction ||
      LogSo3(correction.rotation).norm() > options_.max_turn) {
    return false;
  }
  verdict->outcome = LoopOutcome::kDegenerate;
  if (match.observable.degenerate_directions > 0) return false;
  verdict->outcome = LoopOutcome::kPoorFit;
  if (verdict->matches < options_.min_matches || verdict->scale > options_.max_scale) return false;
  verdict->T_target_query.T_a_b = match.T_map_body;
  verdict->T_target_query.covariance =
      PlusToExpCovariance(match.covariance, match.T_map_body) +
      Diagonal(options_.floor_rotation_sigma, options_.floor_position_sigma);
  return true;
}

}  // namespace regolith
