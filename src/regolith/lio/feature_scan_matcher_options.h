// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/lio/curvature_features_options.h"
#include "regolith/lio/feature_map_options.h"

namespace regolith {

struct FeatureScanMatcherOptions {
  CurvatureFeatureOptions curvature;
  FeatureMapOptions map;
  /// Distances of neighbouring features share errors of the map: each counts as this share of an
  /// independent one.
  double independence = 0.02;

  /// Throws CheckError on values that match nothing.
  void Check() const;
};

}  // namespace regolith
