// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/feature_extractor.h"

#include "regolith/core/error.h"
#include "regolith/features/network_extractor.h"
#include "regolith/features/orb_extractor.h"
#include "regolith/features/shi_tomasi_extractor.h"

namespace regolith {

std::unique_ptr<FeatureExtractor> FeatureExtractor::Create(
    const FeatureOptions& options, const std::optional<ModelManifest>& manifest) {
  options.Check();
  if (options.frontend == "orb") return CreateOrbExtractor(options);
  if (options.frontend == "st_lk") return CreateShiTomasiExtractor(options);
  if (!manifest) {
    throw InputError("features.frontend",
                     "`" + options.frontend + "` is a network, but no model was given");
  }
  return CreateNetworkExtractor(options, *manifest);
}

}  // namespace regolith
