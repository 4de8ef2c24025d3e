// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "regolith/terrain/height_grid.h"

namespace regolith {

/// Indices of the posts that stand off all their neighbours by far more than the ground around is
/// rough: blunders of a matcher, or of an altimeter. Cliffs and summits are none.
std::vector<size_t> FindSpikes(const HeightGrid& grid);

}  // namespace regolith
