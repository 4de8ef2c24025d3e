// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/config/fields.h"
#include "regolith/system/pipeline_options.h"

namespace regolith {

/// The pipeline that a document describes, checked. Throws InputError that names file, line and
/// key.
PipelineOptions LoadPipeline(const YamlDocument& document);

/// The pipeline as YAML that LoadPipeline reads back.
std::string WritePipeline(const PipelineOptions& options);

}  // namespace regolith
