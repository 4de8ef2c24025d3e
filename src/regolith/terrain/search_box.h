// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "regolith/terrain/dem.h"

namespace regolith {

/// Where on an elevation model a path is looked for (m, frame `map`): the whole of a small one; of
/// a large one a square around its centre or, where that is steep or has holes, a gentler one.
Eigen::AlignedBox2d SearchBox(const Dem& dem);

}  // namespace regolith
