// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/core/thread_pool.h"
#include "regolith/geometry/se3.h"
#include "regolith/lio/scan_features.h"
#include "regolith/lio/two_step_matcher_options.h"

namespace regolith {

/// The features of the last scan, to be searched.
struct FeatureTarget {
  FeatureTarget() = default;
  explicit FeatureTarget(const ScanFeatures& features);

  RingSearch edges;
  RingSearch ground;
  RingSearch clusters;
};

struct TwoStepMatch {
  SE3 T_last_current;
  bool used_ground = false;  ///< false: too few matches, z, roll and pitch are the guess's
  bool used_edges = false;   ///< false: x, y and yaw are
};

/// The motion between two scans by the two-step optimisation of Shan & Englot 2018, section III-D:
/// flat points on the planes of the last scan's ground give height, roll and pitch; then, with
/// these held, edges on lines, and points of clusters on planes, give the rest. `up_lidar`: the
/// axis that tells the two apart.
TwoStepMatch MatchTwoStep(const ScanFeatures& current, const FeatureTarget& last,
                          const SE3& T_last_current_guess, const Eigen::Vector3d& up_lidar,
                          const TwoStepMatcherOptions& options, ThreadPool* threads);

}  // namespace regolith
