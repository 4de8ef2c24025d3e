// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/core/span.h"
#include "regolith/sim/drive.h"

namespace regolith {

/// Where a path, poses `interval` s apart, comes back to its own track.
std::vector<Revisit> FindRevisits(Span<const PlanarPose> path, double interval);

}  // namespace regolith
