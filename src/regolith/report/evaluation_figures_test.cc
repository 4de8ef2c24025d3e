// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/evaluation_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"
#include "regolith/report/test_folder_internal.h"

namespace regolith {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<StampedPose> Curve(double error) {
  std::vector<StampedPose> poses;
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.04 * i;
    poses.push_back({FromSeconds(3.0 + 0.1 * i),
                     SE3(ExpSo3({0, 0, angle}), {5.0 * std::sin(angle), -5.0 * std::cos(angle),
                                                 0.2 * angle + error * std::sin(0.5 * i)})});
  }
  return poses;
}

using EvaluationFiguresTest = FigureFolderTest;

TEST_F(EvaluationFiguresTest, DrawsEveryFigureWithItsDataAndScript) {
  const std::vector<StampedPose> reference = Curve(0.0);
  const Evaluation first = EvaluateTrajectory({"r", reference}, {"a", Curve(0.1)}, {});
  const Evaluation second = EvaluateTrajectory({"r", reference}, {"b", Curve(0.2)}, {});
  DrawEvaluation(folder_, {{"it's a", &first, {1.0, 2.0, 3.0}}, {"b", &second, {}}});
  const bool has_gnuplot = std::filesystem::exists(folder_ + "/ape.png");
  for (const char* name :
       {"trajectory", "axes", "ape", "ape_distance", "yaw", "track_error", "ape_box", "timing"}) {
    EXPECT_FALSE(Text(std::string(name) + ".dat").empty()) << name;
    EXPECT_THAT(Text(std::string(name) + ".gp"), HasSubstr(".dat'")) << name;
    if (!has_gnuplot) continue;
    EXPECT_THAT(Text(std::string(name) + ".png"), HasSubstr("PNG")) << name;
    EXPECT_THAT(Text(std::string(name) + ".svg"), HasSubstr("</svg>")) << name;
  }
  // The heading is unwound: the curve turns by 8 rad.
  EXPECT_THAT(Text("axes.dat"), HasSubstr(" 456.0744\n"));
  EXPECT_THAT(Text("timing.dat"), HasSubstr("\n1 1 1.5 2 2.5 3  # it's a\n"));
  EXPECT_THAT(Text("timing.dat"), Not(HasSubstr("# b")));
  if (!has_gnuplot) GTEST_SKIP() << "SKIPPED: gnuplot is not installed, pictures were not checked";
}

TEST_F(EvaluationFiguresTest, RefusesNothing) {
  EXPECT_THROW(DrawEvaluation(folder_, {}), CheckError);
}

}  // namespace
}  // namespace regolith
