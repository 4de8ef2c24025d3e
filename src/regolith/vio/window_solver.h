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
  /// The whole final cost over the number of sightings: about 0.5 where the noise is what the
  /// options say, less where it is smaller.
  double visual_cost = 0.0;
};

/// Finds the states of a window that explain its measurements best (Ceres; landmarks are eliminated
/// by Schur's complement). Iterations are bounded, not time: the same on every computer.
WindowSolution SolveWindow(SlidingWindow* window, int max_iterations);

}  // namespace regolith
