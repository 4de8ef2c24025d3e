// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/feature_frontend.h"

#include "regolith/features/lk_frontend.h"
#include "regolith/features/matching_frontend.h"

namespace regolith {

std::unique_ptr<FeatureFrontend> FeatureFrontend::Create(
    const FeatureOptions& options, const CameraModel* camera,
    const std::optional<ModelManifest>& manifest) {
  std::unique_ptr<FeatureExtractor> extractor = FeatureExtractor::Create(options, manifest);
  if (options.frontend == "st_lk" || options.frontend == "ghost_lk") {
    return CreateLkFrontend(options, camera, std::move(extractor));
  }
  return CreateMatchingFrontend(options, camera, std::move(extractor));
}

}  // namespace regolith
