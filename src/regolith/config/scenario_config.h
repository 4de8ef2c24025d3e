// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/config/fields.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// The scenario that a document describes, checked. Throws InputError that names file, line and
/// key.
ScenarioOptions LoadScenario(const YamlDocument& document);

/// The scenario as YAML that LoadScenario reads back, with the program's version in a comment.
std::string WriteScenario(const ScenarioOptions& options);

}  // namespace regolith
