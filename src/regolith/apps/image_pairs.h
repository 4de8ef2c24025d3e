// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/sim/simulator.h"

namespace regolith {

/// Writes `count` image pairs with their true correspondence into a folder (docs/architecture.md,
/// "Recording"): index.csv, ID_1.png, ID_2.png, ID_flow.tif. False where it was interrupted: then
/// index.partial.csv lists the pairs that are there.
bool WritePairs(Simulator& simulator, int count, bool quiet, const std::string& folder);

}  // namespace regolith
