// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/geometry/trajectory.h"

namespace regolith {

/// Indices of two poses of nearly the same time.
struct PosePair {
  size_t reference = 0;
  size_t estimate = 0;
};

/// Pairs poses by time as evo_ape and evo_rpe do: each pose of the shorter series (of the estimate
/// where both are equally long) is given the pose of the other that is nearest in time, the earlier
/// one of two equally near, if it is no more than `max_difference` seconds away. A pose of the
/// longer series may so be used twice. Both series are sorted by time; stamps may repeat.
std::vector<PosePair> AssociateByTime(Span<const StampedPose> reference,
                                      Span<const StampedPose> estimate, double max_difference);

}  // namespace regolith
