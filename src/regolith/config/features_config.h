// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/config/fields.h"
#include "regolith/features/feature_options.h"

namespace regolith {

/// The options below the key `features:` of a document that holds nothing else, checked. Throws
/// InputError that names file, line and key.
FeatureOptions LoadFeatures(const YamlDocument& document);

/// The options as YAML that LoadFeatures reads back.
std::string WriteFeatures(const FeatureOptions& options);

}  // namespace regolith
