// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/backend/loop_verifier_options.h"
#include "regolith/backend/relief_match.h"
#include "regolith/backend/uncertain_pose.h"
#include "regolith/core/span.h"
#include "regolith/core/thread_pool.h"

namespace regolith {

/// What became of a loop that was proposed.
enum class LoopOutcome {
  kAccepted,
  kTooLittleOverlap,  ///< the two places share too little ground
  kOtherGround,       ///< nowhere near the guess do the shapes agree
  kAmbiguous,         ///< they agree elsewhere about as well
  kNotAligned,        ///< registration found too few planes or went elsewhere
  kDegenerate,        ///< registration leaves a direction open
  kPoorFit,           ///< points lie off the planes
  kInconsistent,      ///< against odometry or other loops (LoopConsistency)
  kUnsupported,       ///< no other loop confirms it yet
};
const char* LoopOutcomeName(LoopOutcome outcome);

/// A proposal: the query stands at about `T_target_query`.
struct LoopGuess {
  SE3 T_target_query;
  double position_radius = 3.0;  ///< m that it may be off by, in x and y
  double yaw_radius = 0.1;       ///< rad
};

struct LoopVerdict {
  LoopOutcome outcome = LoopOutcome::kTooLittleOverlap;
  UncertainPose T_target_query;  ///< where accepted
  ReliefMatch relief;
  double agreement = 0.0;  ///< where registration placed it
  double matches = 0.0;    ///< share of the points that found a plane
  double scale = 0.0;      ///< m, robust standard deviation of their distances
};

/// Confirms loops by lidar alone. The shape of the ground is laid over that of the old place at all
/// offsets within the guess's doubt. At the best of them point-to-plane registration has to hold in
/// all six directions, and there the shapes have to agree, clearly better than anywhere else.
class LoopVerifier {
 public:
  LoopVerifier(const LoopVerifierOptions& options, ThreadPool* threads);

  /// Points (m) in the body frames of the two keyframes. `R_level_target` turns the target's body
  /// frame level.
  LoopVerdict Verify(Span<const Eigen::Vector3d> query, Span<const Eigen::Vector3d> target,
                     const LoopGuess& guess, const Eigen::Quaterniond& R_level_target) const;

 private:
  /// False, with the outcome, where it does not hold.
  bool Register(Span<const Eigen::Vector3d> query, Span<const Eigen::Vector3d> target,
                const SE3& T_target_query, LoopVerdict* verdict) const;

  LoopVerifierOptions options_;
  ThreadPool* threads_;
};

}  // namespace regolith
