// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/features/model_manifest.h"

namespace regolith {

/// The manifest models/NAME.yaml, checked; paths in it are relative to its folder and come back as
/// paths that open from here. Keys: name, file, sha256, input, outputs.{logits, descriptors} (each
/// {name, shape}), normalisation {mean, scale, per_image}, and for tests and people parity {input,
/// logits, descriptors}, training, licence, description. Throws InputError that names file, line
/// and key; what the network's file holds is checked where it is loaded (features).
ModelManifest LoadModelManifest(const std::string& yaml_path);

}  // namespace regolith
