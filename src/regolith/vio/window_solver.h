// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/vio/sliding_window.h"

namespace regolith {

struct WindowSolution {
  bool is_usable = false;  ///< the solver found values; else those before stand
  int iterations = 0;
  int landmarks = 0;
  int sightings = 0;
  /// Mean squared residual, in variances, of the sightings: about 1 (half of it a Cauchy loss takes
  /// off) where the noise is what the options say.
  double visual_cost = 0.0;
};

/// Finds the states of a window that explain its measurements best (Ceres; landmarks are eliminated
/// by Schur's complement). Iterations are bounded, not time: the same on every computer.
WindowSolution SolveWindow(SlidingWindow* window, int max_iterations);

}  // namespace regolith
