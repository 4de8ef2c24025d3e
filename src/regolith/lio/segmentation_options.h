// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/lio/cluster_segmentation_options.h"
#include "regolith/lio/curvature_features_options.h"
#include "regolith/lio/ground_segmentation_options.h"

namespace regolith {

struct SegmentationOptions {
  GroundSegmentationOptions ground;
  ClusterSegmentationOptions clusters;
  CurvatureFeatureOptions features;

  /// Throws CheckError on values that make no features.
  void Check() const;
};

}  // namespace regolith
