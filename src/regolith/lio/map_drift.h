// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/geometry/se3.h"
#include "regolith/lio/map_drift_options.h"

namespace regolith {

/// How far the local map may have drifted from the world, which no match against the map can see:
/// what the map holds was placed by poses with errors of their own. Each stretch of new ground is
/// placed by matches whose errors it keeps, so the error grows with the way, not with time.
class MapDrift {
 public:
  explicit MapDrift(const MapDriftOptions& options) : options_(options) {}

  /// Moves on from one pose to the next. `match_covariance`: [rotation (right), position], of the
  /// later pose against the map.
  void Advance(const SE3& T_map_from, const SE3& T_map_to, const Matrix6d& match_covariance);

  /// A new map begins at the latest pose, whose covariance against the old one is given.
  void BeginMap(const Matrix6d& pose_covariance) { covariance_ += pose_covariance; }

  /// Of the latest pose, as Plus() perturbs it: [rotation (right, rad), position (m)].
  const Matrix6d& covariance() const { return covariance_; }

 private:
  MapDriftOptions options_;
  Matrix6d covariance_ = Matrix6d::Zero();
};

}  // namespace regolith
