// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "regolith/features/feature_extractor.h"

namespace regolith {

/// ORB (Rublee et al. 2011): FAST corners on a pyramid of scales, ranked by Harris' measure and
/// spread over the cells, with 256-bit descriptors turned with the patch. Beyond the paper: cells
/// without a corner are asked again with a lower threshold, and corners of several levels at one
/// place count once. Scores are Harris' measure.
std::unique_ptr<FeatureExtractor> CreateOrbExtractor(const FeatureOptions& options);

}  // namespace regolith
