// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/network_extractor.h"

#include "regolith/core/error.h"

namespace regolith {

// Stands in until the real one is merged.
std::unique_ptr<FeatureExtractor> CreateNetworkExtractor(const FeatureOptions& options,
                                                         const ModelManifest& /*manifest*/) {
  throw InputError("features.frontend", options.frontend + " is not built in");
}

}  // namespace regolith
