// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/span.h"

namespace regolith {

/// What evo reports of a series of errors, in the unit of the errors (sse: its square).
struct ErrorStatistics {
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;  ///< mean of the two middle values where their number is even
  double std = 0.0;     ///< of the population: divided by n
  double min = 0.0;
  double max = 0.0;
  double sse = 0.0;  ///< sum of squares
};

/// Throws CheckError for an empty series.
ErrorStatistics ComputeErrorStatistics(Span<const double> errors);

}  // namespace regolith
