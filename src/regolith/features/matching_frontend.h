// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "regolith/features/feature_frontend.h"

namespace regolith {

/// Detects keypoints in every image and matches their descriptors with those of the tracks.
std::unique_ptr<FeatureFrontend> CreateMatchingFrontend(
    const FeatureOptions& options, const CameraModel* camera,
    std::unique_ptr<FeatureExtractor> extractor);

}  // namespace regolith
