// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/feature_setup.h"

#include "regolith/config/install_paths.h"
#include "regolith/config/model_config.h"
#include "regolith/core/error.h"

namespace regolith {

std::optional<ModelManifest> PrepareModel(FeatureOptions* options) {
  options->Check();
  std::string model;
  for (const FrontendName& known : kFrontends) {
    if (options->frontend == known.name) model = known.model;
  }
  const std::string& asked = options->network.model;
  if (model.empty()) {
    if (asked.empty()) return std::nullopt;
    throw InputError("features.model",
                     "is " + asked + ", but " + options->frontend + " runs no network");
  }
  if (options->network.cache.empty()) options->network.cache = CacheFolder("models");
  return LoadModelManifest(FindModel(asked.empty() ? model : asked));
}

}  // namespace regolith
