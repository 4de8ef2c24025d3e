// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "regolith/core/check.h"

namespace regolith {

ErrorStatistics ComputeErrorStatistics(Span<const double> errors) {
  REGOLITH_CHECK(!errors.empty(), "no errors");
  std::vector<double> sorted(errors.begin(), errors.end());
  std::sort(sorted.begin(), sorted.end());
  const double count = static_cast<double>(sorted.size());
  ErrorStatistics statistics;
  for (const double error : sorted) {
    statistics.mean += error / count;
    statistics.sse += error * error;
  }
  double squares = 0.0;
  for (const double error : sorted) {
    squares += (error - statistics.mean) * (error - statistics.mean);
  }
  const size_t middle = sorted.size() / 2;
  statistics.median =
      sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
  statistics.rmse = std::sqrt(statistics.sse / count);
  statistics.std = std::sqrt(squares / count);
  statistics.min = sorted.front();
  statistics.max = sorted.back();
  return statistics;
}

}  // namespace regolith
