// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"

namespace regolith {

struct FactorGraphOptions {
  int max_iterations = 25;  ///< of a solve, which starts from the last one's result
  /// Standard deviations beyond which the pull of a robust edge grows no more (Cauchy).
  double robust_width = 3.0;

  void Check() const {
    REGOLITH_CHECK(max_iterations >= 1, "max_iterations=", max_iterations);
    REGOLITH_CHECK(robust_width > 0.0, "robust_width=", robust_width);
  }
};

}  // namespace regolith
