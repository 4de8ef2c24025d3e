// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"

namespace regolith {

/// Between neighbouring beams of a ring, the range jumps where it changes by more than `step` and
/// `slope` times the distance between the beams there: chosen on `mars` (docs/lidar.md).
struct RangeJumpOptions {
  double step = 0.08;  ///< m, above what noise makes
  double slope = 1.5;  ///< m a m; ground that a beam meets more flatly counts as a jump
  /// rad, beams farther apart are no neighbours: those between them have come back from nowhere.
  double max_angle = 0.05;

  void Check() const {
    REGOLITH_CHECK(step > 0.0, "step=", step);
    REGOLITH_CHECK(slope >= 0.0, "slope=", slope);
    REGOLITH_CHECK(max_angle > 0.0, "max_angle=", max_angle);
  }
};

}  // namespace regolith
