// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/time.h"

#include <gtest/gtest.h>

namespace regolith {
namespace {

TEST(Time, SecondsRoundTripToTheNanosecond) {
  const TimeNs start = 1403636583763555584;
  EXPECT_EQ(AddSeconds(start, 0.000000001), start + 1);
  EXPECT_EQ(AddSeconds(start, -1.5), start - 1500000000);
  EXPECT_DOUBLE_EQ(SecondsBetween(start, AddSeconds(start, 12.345678901)), 12.345678901);
}

}  // namespace
}  // namespace regolith
