// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/lio/feature_map_options.h"
#include "regolith/lio/keyframe_graph_options.h"
#include "regolith/lio/segmentation_options.h"
#include "regolith/lio/two_step_matcher_options.h"

namespace regolith {

struct LegoLoamOptions {
  SegmentationOptions segmentation;
  TwoStepMatcherOptions odometry;
  FeatureMapOptions map;
  KeyframeGraphOptions keyframes;
  /// Moves each point by constant velocity to the middle of its sweep; needs firing times.
  bool deskew = true;
  /// 1 σ of what the motion between two scans may differ from that before, for the covariance of
  /// directions that the features do not determine.
  double velocity_rotation_sigma = 0.05;  ///< rad
  double velocity_position_sigma = 0.3;   ///< m
  /// Distances of neighbouring features share errors of the map: each counts as this share of an
  /// independent one in the covariance.
  double independence = 0.02;

  /// Throws CheckError on values that make no odometry.
  void Check() const;
};

}  // namespace regolith
