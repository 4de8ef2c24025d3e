// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "regolith/core/error.h"
#include "regolith/report/gnuplot.h"
#include "regolith/report/test_folder_internal.h"

namespace regolith {
namespace {

using ::testing::HasSubstr;
using FiguresTest = FigureFolderTest;

std::vector<StampedPose> Line() {
  std::vector<StampedPose> poses(3);
  for (int i = 0; i < 3; ++i) {
    poses[static_cast<size_t>(i)].T_world_body.translation = {1.0 * i, 0.5 * i, 0.0};
  }
  return poses;
}

TEST_F(FiguresTest, LeavesDataAndScriptBesidePictures) {
  const bool drawn =
      DrawTrajectories(folder_, "It's a title_1", {{"truth", Line()}, {"estimate", Line()}});
  EXPECT_THAT(Text("trajectory.dat"), HasSubstr("# truth\n0 0\n1 0.5\n2 1\n\n\n# estimate"));
  EXPECT_THAT(Text("trajectory.gp"), HasSubstr("set title 'It''s a title_1'"));
  if (!drawn) GTEST_SKIP() << "SKIPPED: gnuplot is not installed, pictures were not checked";
  EXPECT_THAT(Text("trajectory.png"), HasSubstr("PNG"));
  EXPECT_THAT(Text("trajectory.svg"), HasSubstr("<svg"));
  ASSERT_TRUE(DrawSeries(folder_, "ape", {"Error", "time, s", "m", true},
                         {{"run", {0.0, 1.0}, {0.1, 0.2}}}));
  EXPECT_THAT(Text("ape.svg"), HasSubstr("<svg"));
}

TEST_F(FiguresTest, WithoutGnuplotWarnsAndGoesOn) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.c_str(), 1);
  const bool drawn = DrawTrajectories(folder_, "title", {{"truth", Line()}});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(drawn);
  EXPECT_THAT(Text("trajectory.dat"), HasSubstr("truth"));
}

TEST_F(FiguresTest, AFolderThatIsNotThereIsAnOutputError) {
  EXPECT_THROW(DrawTrajectories(folder_ + "/no", "title", {{"truth", Line()}}), OutputError);
}

}  // namespace
}  // namespace regolith
