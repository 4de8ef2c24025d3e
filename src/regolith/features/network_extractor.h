// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "regolith/features/feature_extractor.h"

namespace regolith {

/// The extractor of a learned network (SuperPoint's layout).
std::unique_ptr<FeatureExtractor> CreateNetworkExtractor(const FeatureOptions& options,
                                                         const ModelManifest& manifest);

}  // namespace regolith
