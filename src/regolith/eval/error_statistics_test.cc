// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/error_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "regolith/core/check.h"

namespace regolith {
namespace {

TEST(ErrorStatistics, OfAnEvenNumberOfErrors) {
  const std::vector<double> errors = {4.0, 1.0, 2.0, 7.0};
  const ErrorStatistics statistics = ComputeErrorStatistics(errors);
  EXPECT_DOUBLE_EQ(statistics.mean, 3.5);
  EXPECT_DOUBLE_EQ(statistics.median, 3.0);
  EXPECT_DOUBLE_EQ(statistics.sse, 70.0);
  EXPECT_DOUBLE_EQ(statistics.rmse, std::sqrt(17.5));
  EXPECT_DOUBLE_EQ(statistics.std, std::sqrt(21.0 / 4.0));
  EXPECT_DOUBLE_EQ(statistics.min, 1.0);
  EXPECT_DOUBLE_EQ(statistics.max, 7.0);
}

TEST(ErrorStatistics, OfOneErrorAndOfNone) {
  const std::vector<double> errors = {2.5};
  const ErrorStatistics statistics = ComputeErrorStatistics(errors);
  EXPECT_DOUBLE_EQ(statistics.median, 2.5);
  EXPECT_DOUBLE_EQ(statistics.std, 0.0);
  EXPECT_THROW(ComputeErrorStatistics({}), CheckError);
}

}  // namespace
}  // namespace regolith
