// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "regolith/apps/reproduce_document.h"

namespace regolith {

/// The paper's figures 1, 2, 8 to 13 from our data, drawn into `out`/figures; what has no data is
/// left out. Files are relative to `out`.
std::vector<DocumentSection> ReproducedFigures(const CellMaker& maker,
                                               const std::vector<SceneResults>& results);

}  // namespace regolith
