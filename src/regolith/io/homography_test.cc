// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/homography.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/test_folder.h"

namespace regolith {
namespace {

using testing::HasSubstr;

std::string ErrorOf(const std::string& text) {
  const TestFolder folder;
  WriteFile(folder.Path("H"), text);
  try {
    ReadHomography(folder.Path("H"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Homography, ReadsThreeLinesOfThreeNumbers) {
  const TestFolder folder;
  WriteFile(folder.Path("H"), "# of a wall\n  1.5 0 -2e1 \n0 2 0.25\n\n1e-4\t0 1\n\n");
  Eigen::Matrix3d expected;
  expected << 1.5, 0, -20, 0, 2, 0.25, 1e-4, 0, 1;
  EXPECT_EQ(ReadHomography(folder.Path("H")), expected);
}

TEST(Homography, RefusesAnythingElse) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("three lines of three"));
  EXPECT_THAT(ErrorOf("1 0 0\n0 1 0\n"), HasSubstr("three lines of three"));
  EXPECT_THAT(ErrorOf("1 0 0\n0 1\n0 0 1\n"), HasSubstr("H:2: expected a homography"));
  EXPECT_THAT(ErrorOf("1 0 0\n0 1 0\n0 0 1\n0 0 1\n"), HasSubstr("H:4"));
  EXPECT_THAT(ErrorOf("1 0 0\n0 one 0\n0 0 1\n"), HasSubstr("`one`"));
  EXPECT_THAT(ErrorOf("1 0 0\n0 nan 0\n0 0 1\n"), HasSubstr("`nan`"));
  EXPECT_THAT(ErrorOf("1 0 0\n2 0 0\n0 0 1\n"), HasSubstr("cannot be inverted"));
  EXPECT_THAT(ErrorOf("0 0 0\n0 0 0\n0 0 0\n"), HasSubstr("cannot be inverted"));
  EXPECT_THROW(ReadHomography("/no/such/file"), InputError);
}

}  // namespace
}  // namespace regolith
