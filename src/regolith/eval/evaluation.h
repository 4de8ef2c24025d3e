// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/eval/error_statistics.h"
#include "regolith/eval/evaluation_options.h"
#include "regolith/geometry/alignment.h"
#include "regolith/geometry/trajectory.h"

namespace regolith {

/// Poses and the name (file) by which messages speak of them.
struct NamedPoses {
  std::string name;
  Span<const StampedPose> poses;
};

/// The error of an estimated trajectory, as evo_ape and evo_rpe define it.
struct Evaluation {
  size_t matched = 0;     ///< associated poses
  double length_m = 0.0;  ///< path of the reference over the associated poses

  ErrorStatistics ape;                     ///< m, after alignment
  ErrorStatistics rpe;                     ///< m, from each pose to the next
  std::optional<ErrorStatistics> rpe_10m;  ///< m, all pairs 10 m apart; none on a shorter path

  std::optional<double> percent_of_distance;  ///< 100 · APE RMSE / length_m; none without motion
  std::optional<double> drift_percent;        ///< 100 · mean of rpe_10m / 10 m
  std::optional<double> rotation_deg_per_m;   ///< mean angle of the same pairs / 10 m
  double rotation_deg = 0.0;                  ///< mean angle of the APE

  std::array<ErrorStatistics, 3> axes;  ///< m, absolute errors along the reference's x, y and z
  ErrorStatistics yaw;                  ///< degrees, absolute errors of the heading about z
  /// Factor that would fit the estimate's size to the reference's, whatever the alignment; none
  /// where the positions determine no similarity.
  std::optional<double> fitted_scale;
  /// Share of the reference's time that lies between associated poses that follow each other within
  /// a second (or three of the estimate's own intervals where it is slower).
  double time_coverage = 0.0;

  Alignment alignment;                 ///< reference ≈ scale · T * estimate
  std::vector<StampedPose> reference;  ///< the associated poses
  std::vector<StampedPose> estimate;   ///< the same, aligned
  std::vector<double> ape_m;           ///< error of each of them
  std::vector<double> ape_deg;
  std::vector<Eigen::Vector3d> offsets_m;  ///< estimate less reference, in the reference's axes
  std::vector<double> yaw_deg;             ///< the same of the heading, in (-180, 180]
  std::vector<double> distance_m;          ///< path of the reference up to each of them
};

/// Names as of --align: "se3", "sim3", "yaw", "origin", "none".
const char* AlignmentName(AlignmentMode mode);

/// Stamps may repeat, as for evo; unlike evo it refuses stamps that run backwards, since path
/// lengths and pairs mean nothing then. Throws InputError that names the file: no pose, NaN,
/// backward stamps, times that do not overlap, fewer than three associated poses, or poses on one
/// line, which determine no rotation.
Evaluation EvaluateTrajectory(const NamedPoses& reference, const NamedPoses& estimate,
                              const EvaluationOptions& options);

/// The reference in the frame (and scale) of the estimate, for pictures beside the estimate's map.
std::vector<StampedPose> ReferenceInEstimateFrame(Span<const StampedPose> reference,
                                                  const Alignment& alignment);

}  // namespace regolith
