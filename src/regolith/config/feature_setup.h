// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "regolith/features/feature_options.h"
#include "regolith/features/model_manifest.h"

namespace regolith {

/// The manifest of the network that a frontend runs: the one that features.model names, else that
/// of the frontend; nothing where it runs none. Fills the folder of compiled networks where the
/// options name none. Throws InputError.
std::optional<ModelManifest> PrepareModel(FeatureOptions* options);

}  // namespace regolith
