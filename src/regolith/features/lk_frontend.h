// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "regolith/features/feature_frontend.h"

namespace regolith {

/// Follows points from image to image by optical flow and looks for new ones where too few are
/// left. Where the extractor describes them, new points are first tried as tracks that were lost.
std::unique_ptr<FeatureFrontend> CreateLkFrontend(const FeatureOptions& options,
                                                  const CameraModel* camera,
                                                  std::unique_ptr<FeatureExtractor> extractor);

}  // namespace regolith
