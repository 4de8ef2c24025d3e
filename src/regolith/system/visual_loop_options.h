// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"
#include "regolith/features/feature_options.h"

namespace regolith {

/// Loops that the camera of a pipeline with a lidar proposes (PlaceObserver, VisualLoops).
struct VisualLoopOptions {
  bool enabled = true;
  int max_keypoints = 500;     ///< ORB, of a keyframe's image
  double scan_distance = 0.2;  ///< m between scans that keypoints take their distances from

  void Check() const {
    REGOLITH_CHECK(max_keypoints >= 1 && max_keypoints <= kMaxKeypoints,
                   "max_keypoints=", max_keypoints, " of at most ", kMaxKeypoints);
    REGOLITH_CHECK(scan_distance >= 0.0, "scan_distance=", scan_distance);
  }
};

}  // namespace regolith
