// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/error.h"

#include <gtest/gtest.h>

#include "regolith/core/check.h"

namespace regolith {
namespace {

TEST(Error, InputErrorNamesThePlaceFirst) {
  EXPECT_STREQ(InputError("rig.yaml:3", "unknown key").what(), "rig.yaml:3: unknown key");
}

TEST(Check, ThrowsWithConditionAndValues) {
  const int rings = -1;
  try {
    REGOLITH_CHECK(rings > 0, "rings=", rings);
    FAIL() << "the check passed";
  } catch (const CheckError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("rings > 0"), std::string::npos) << message;
    EXPECT_NE(message.find("rings=-1"), std::string::npos) << message;
    EXPECT_NE(message.find("error_test.cc"), std::string::npos) << message;
    EXPECT_STREQ(error.expectation(), "expected rings > 0: rings=-1");
  }
}

}  // namespace
}  // namespace regolith
