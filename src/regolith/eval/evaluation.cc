// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/evaluation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/eval/association.h"
#include "regolith/eval/pose_error.h"
#include "regolith/eval/trajectory_alignment.h"

namespace regolith {
namespace {

constexpr double kDegreesPerRadian = 180.0 / M_PI;
constexpr size_t kLeastPoses = 3;

std::string Seconds(TimeNs time) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.6f s", ToSeconds(time));
  return text;
}

void CheckPoses(const NamedPoses& trajectory) {
  if (trajectory.poses.empty()) {
    throw InputError(trajectory.name, "has no poses; expected lines 'stamp tx ty tz qx qy qz qw'");
  }
  for (size_t i = 0; i < trajectory.poses.size(); ++i) {
    const StampedPose& pose = trajectory.poses[i];
    if (!pose.T_world_body.translation.allFinite() ||
        !pose.T_world_body.rotation.coeffs().allFinite()) {
      throw InputError(trajectory.name, Concatenate("pose ", i + 1, " at ", Seconds(pose.time),
                                                    " is not finite; remove its line"));
    }
    if (i > 0 && pose.time < trajectory.poses[i - 1].time) {
      throw InputError(
          trajectory.name,
          Concatenate("stamps run backwards at pose ", i + 1, ": ", Seconds(pose.time), " after ",
                      Seconds(trajectory.poses[i - 1].time), "; sort the file by time (sort -n)"));
    }
  }
}

std::string Range(const NamedPoses& trajectory) {
  return Concatenate(trajectory.poses.size(), " poses from ",
                     Seconds(trajectory.poses.front().time), " to ",
                     Seconds(trajectory.poses.back().time));
}

std::vector<PosePair> Associate(const NamedPoses& reference, const NamedPoses& estimate,
                                double max_difference) {
  std::vector<PosePair> pairs = AssociateByTime(reference.poses, estimate.poses, max_difference);
  if (pairs.size() < kLeastPoses) {
    throw InputError(
        estimate.name,
        Concatenate("only ", pairs.size(), " poses lie within ", max_difference, " s of a pose of ",
                    reference.name, ", at least ", kLeastPoses,
                    " are needed (estimate: ", Range(estimate), "; reference: ", Range(reference),
                    "); check that both use the same clock or raise "
                    "--max-difference"));
  }
  return pairs;
}

std::vector<SE3> Poses(Span<const StampedPose> stamped) {
  std::vector<SE3> poses;
  for (const StampedPose& pose : stamped) poses.push_back(pose.T_world_body);
  return poses;
}

Alignment Align(const Evaluation& evaluation, const std::string& name, AlignmentMode mode) {
  const auto alignment = AlignTrajectory(evaluation.reference, evaluation.estimate, mode);
  if (!alignment) {
    throw InputError(name,
                     "its positions or those of the reference lie on one line, so that no rotation "
                     "aligns them; use --align none where both share a frame");
  }
  return *alignment;
}

void ApplyAlignment(const Alignment& alignment, std::vector<StampedPose>* poses) {
  for (StampedPose& pose : *poses) {
    pose.T_world_body = alignment.T_target_source * pose.T_world_body;
    pose.T_world_body.translation *= alignment.scale;
  }
}

double Mean(const std::vector<double>& values) { return ComputeErrorStatistics(values).mean; }

void MeasureAbsolute(const std::vector<SE3>& reference, const std::vector<SE3>& estimate,
                     Evaluation* evaluation) {
  PoseErrors errors = AbsolutePoseErrors(reference, estimate);
  evaluation->ape = ComputeErrorStatistics(errors.translation);
  evaluation->rotation_deg = Mean(errors.angle) * kDegreesPerRadian;
  evaluation->length_m = PathLength(reference);
  if (evaluation->length_m > 0.0) {
    evaluation->percent_of_distance = 100.0 * evaluation->ape.rmse / evaluation->length_m;
  }
  evaluation->ape_m = std::move(errors.translation);
  evaluation->ape_deg = std::move(errors.angle);
  for (double& angle : evaluation->ape_deg) angle *= kDegreesPerRadian;
}

double YawOf(const SE3& pose) {
  const Eigen::Vector3d forward = pose.rotation * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

void MeasureAxes(const std::vector<SE3>& reference, const std::vector<SE3>& estimate,
                 Evaluation* evaluation) {
  std::array<std::vector<double>, 3> axes;
  std::vector<double> yaw;
  double distance = 0.0;
  for (size_t i = 0; i < reference.size(); ++i) {
    if (i > 0) distance += (reference[i].translation - reference[i - 1].translation).norm();
    const Eigen::Vector3d offset = estimate[i].translation - reference[i].translation;
    const double turn =
        std::remainder(YawOf(estimate[i]) - YawOf(reference[i]), 2.0 * M_PI) * kDegreesPerRadian;
    evaluation->distance_m.push_back(distance);
    evaluation->offsets_m.push_back(offset);
    evaluation->yaw_deg.push_back(turn);
    for (int axis = 0; axis < 3; ++axis) {
      axes[static_cast<size_t>(axis)].push_back(std::abs(offset[axis]));
    }
    yaw.push_back(std::abs(turn));
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    evaluation->axes[axis] = ComputeErrorStatistics(axes[axis]);
  }
  evaluation->yaw = ComputeErrorStatistics(yaw);
}

/// Of associated poses and the reference that they were taken from.
double TimeCoverage(Span<const StampedPose> reference, const std::vector<StampedPose>& matched) {
  const double whole = SecondsBetween(reference.front().time, reference.back().time);
  if (!(whole > 0.0)) return 1.0;
  std::vector<double> intervals;
  for (size_t i = 1; i < matched.size(); ++i) {
    intervals.push_back(SecondsBetween(matched[i - 1].time, matched[i].time));
  }
  const double longest = std::max(1.0, 3.0 * ComputeErrorStatistics(intervals).median);
  double covered = 0.0;
  for (const double interval : intervals) covered += interval <= longest ? interval : 0.0;
  return std::min(1.0, covered / whole);
}

void MeasureRelative(const std::vector<SE3>& reference, const std::vector<SE3>& estimate,
                     const EvaluationOptions& options, Evaluation* evaluation) {
  const std::vector<SegmentEnds> steps = ConsecutivePairs(reference.size());
  evaluation->rpe =
      ComputeErrorStatistics(RelativePoseErrors(reference, estimate, steps).translation);

  // evo takes the pairs from the estimate unless it is told otherwise.
  const std::vector<SegmentEnds> segments =
      PairsByPathLength(estimate, options.segment_length, options.segment_tolerance);
  if (segments.empty()) return;
  const PoseErrors errors = RelativePoseErrors(reference, estimate, segments);
  evaluation->rpe_10m = ComputeErrorStatistics(errors.translation);
  evaluation->drift_percent = 100.0 * evaluation->rpe_10m->mean / options.segment_length;
  evaluation->rotation_deg_per_m = Mean(errors.angle) * kDegreesPerRadian / options.segment_length;
}

}  // namespace

Evaluation EvaluateTrajectory(const NamedPoses& reference, const NamedPoses& estimate,
                              const EvaluationOptions& options) {
  options.Check();
  CheckPoses(reference);
  CheckPoses(estimate);
  Evaluation evaluation;
  for (const PosePair& pair : Associate(reference, estimate, options.max_difference)) {
    evaluation.reference.push_back(reference.poses[pair.reference]);
    evaluation.estimate.push_back(estimate.poses[pair.estimate]);
  }
  evaluation.matched = evaluation.reference.size();
  evaluation.fitted_scale = FitScale(evaluation.reference, evaluation.estimate);
  evaluation.time_coverage = TimeCoverage(reference.poses, evaluation.reference);
  evaluation.alignment = Align(evaluation, estimate.name, options.alignment);
  ApplyAlignment(evaluation.alignment, &evaluation.estimate);

  const std::vector<SE3> reference_poses = Poses(evaluation.reference);
  const std::vector<SE3> estimate_poses = Poses(evaluation.estimate);
  MeasureAbsolute(reference_poses, estimate_poses, &evaluation);
  MeasureRelative(reference_poses, estimate_poses, options, &evaluation);
  MeasureAxes(reference_poses, estimate_poses, &evaluation);
  return evaluation;
}

const char* AlignmentName(AlignmentMode mode) {
  switch (mode) {
    case AlignmentMode::kSe3:
      return "se3";
    case AlignmentMode::kSim3:
      return "sim3";
    case AlignmentMode::kYaw:
      return "yaw";
    case AlignmentMode::kOrigin:
      return "origin";
    case AlignmentMode::kNone:
      break;
  }
  return "none";
}

std::vector<StampedPose> ReferenceInEstimateFrame(Span<const StampedPose> reference,
                                                  const Alignment& alignment) {
  const SE3 T_estimate_reference = alignment.T_target_source.Inverse();
  std::vector<StampedPose> moved(reference.begin(), reference.end());
  for (StampedPose& pose : moved) {
    pose.T_world_body.translation /= alignment.scale;
    pose.T_world_body = T_estimate_reference * pose.T_world_body;
  }
  return moved;
}

}  // namespace regolith
