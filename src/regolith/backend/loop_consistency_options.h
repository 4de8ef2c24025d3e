// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"

namespace regolith {

struct LoopConsistencyOptions {
  double max_squared_distance = 22.5;  ///< χ² of six degrees of freedom: one in a thousand
  /// What odometry states is multiplied by this, 1 σ: it may be too sure of itself.
  double odometry_inflation = 1.0;
  /// Squared distance of a loop from the graph, by its own errors alone: less confirms what is
  /// known already (χ² of six degrees of freedom: one in twenty).
  double confirming_squared_distance = 12.6;
  int min_support = 2;            ///< other loops that a loop has to agree with
  double support_sigma = 0.6;     ///< m; a looser cycle of two loops confirms nothing
  double support_distance = 0.5;  ///< m driven between two loops, at either end, that count as two
  int max_loops = 400;            ///< the newest; older ones keep what was decided of them

  void Check() const {
    REGOLITH_CHECK(max_squared_distance > 0.0, "max_squared_distance=", max_squared_distance);
    REGOLITH_CHECK(odometry_inflation >= 1.0, "odometry_inflation=", odometry_inflation);
    REGOLITH_CHECK(confirming_squared_distance >= 0.0,
                   "confirming_squared_distance=", confirming_squared_distance);
    REGOLITH_CHECK(min_support >= 0, "min_support=", min_support);
    REGOLITH_CHECK(support_sigma > 0.0, "support_sigma=", support_sigma);
    REGOLITH_CHECK(support_distance >= 0.0, "support_distance=", support_distance);
    REGOLITH_CHECK(max_loops >= 10, "max_loops=", max_loops);
  }
};

}  // namespace regolith
