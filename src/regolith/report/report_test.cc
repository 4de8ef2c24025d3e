// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "regolith/core/check.h"

namespace regolith {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ReportData SmallReport() {
  ReportData data;
  data.title = "lunar_short <seed 1>";
  data.pipeline = "lio";
  data.highlights = {{"Distance", "17.2 m"}};
  data.summary = {{"coverage", "100 %"}};
  data.configuration = "voxel_size: 0.4\n";
  for (int i = 0; i < 50; ++i) {
    StampedPose pose;
    pose.time = FromSeconds(100.0 + 0.1 * i);
    pose.T_world_body.translation = {0.05 * i, std::sin(0.1 * i), 0.0};
    data.estimate.push_back(pose);
    pose.T_world_body.translation.z() = 0.25;
    data.reference.push_back(pose);
  }
  data.start = data.estimate.front().time;
  data.duration = 4.9;
  data.estimate_error.assign(50, 0.25);
  data.ape = ErrorStatistics();
  data.ape->rmse = 0.0625;
  data.errors = {{"APE", {0.0, 0.1, 0.2}, {0.01, std::nan(""), 0.03}}};
  data.yaw_error = ReportSeries{"heading", {0.0, 0.1}, {0.5, -0.5}};
  data.map = {{{1.0F, 2.0F, 3.0F}, 3.0F}, {{4.0F, 5.0F, 6.5F}, 6.5F}};
  data.stages = {{"deskew", 1.5, 2.5}};
  data.features = {{"tracked", {0.0, 1.0}, {200.0, 210.0}}};
  data.leader = {{"lidar+imu", 0.0, 3.0}, {"imu", 3.0, 4.9}};
  data.degenerate = ReportSeries{"degenerate", {0.0, 3.0}, {0.0, 1.0}};
  data.groups = {{"Matching", "points", false, {{"inliers", {0.0, 1.0}, {900.0, 950.0}}}}};
  data.keyframes = {data.estimate.front()};
  data.loops = {{data.estimate.back().time, {1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}};
  ReportFrame frame;
  frame.caption = "1 feature <here>";
  frame.width = 8;
  frame.height = 4;
  frame.grey.assign(32, 90);
  frame.features = {{{1.5F, 2.0F}, {3.0F, 2.5F}}};
  data.frames = {frame};
  return data;
}

/// A stand-in for the library, so that the test does not need the Python tools.
class FakePlotly {
 public:
  FakePlotly() : path_(::testing::TempDir() + "plotly" + std::to_string(::getpid()) + ".js") {
    std::ofstream(path_) << "/* fake plotly */";
  }
  ~FakePlotly() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(Report, HoldsItsDataAndTheLibraryAndNothingFromANetwork) {
  const FakePlotly plotly;
  const std::string html = RenderReport(SmallReport(), plotly.path());
  EXPECT_THAT(html, HasSubstr("/* fake plotly */"));
  EXPECT_THAT(html, HasSubstr("lunar_short &lt;seed 1&gt;"));
  EXPECT_THAT(html, HasSubstr("0.0625 m"));
  EXPECT_THAT(html, HasSubstr("v:[0.01,null,0.03]"));
  EXPECT_THAT(html, HasSubstr("All 2 points"));
  EXPECT_THAT(html, HasSubstr("voxel_size: 0.4"));
  EXPECT_THAT(html, HasSubstr("1 feature &lt;here&gt;"));
  EXPECT_THAT(html, HasSubstr("M1.5 2 L3 2.5 "));
  EXPECT_THAT(html, HasSubstr("src=\"data:image/jpeg;base64,/9j/"));
  EXPECT_THAT(html, HasSubstr("{name:\"imu\",from:3,to:4.9,}"));
  EXPECT_THAT(html, HasSubstr("loops:[{from:[1,2,3],to:[4,5,6],t:4.9,}"));
  EXPECT_THAT(html, HasSubstr("id=\"group_0\""));
  EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_EQ(html, RenderReport(SmallReport(), plotly.path()));
}

TEST(Report, WithoutPlotlyHasTablesAndSaysWhy) {
  const std::string html = RenderReport(SmallReport(), "/nowhere/plotly.min.js");
  EXPECT_THAT(html, HasSubstr("plotly.min.js was not found at /nowhere/plotly.min.js"));
  EXPECT_THAT(html, HasSubstr("0.0625 m"));
  EXPECT_THAT(html, HasSubstr("deskew"));
  EXPECT_THAT(html, Not(HasSubstr("const data")));
}

TEST(Report, ThinsALargeMapAndSaysSo) {
  const FakePlotly plotly;
  ReportData data = SmallReport();
  data.map.resize(350000);
  const std::string html = RenderReport(data, plotly.path());
  EXPECT_THAT(html, HasSubstr("thinned to 300000 of its 350000 points"));
  EXPECT_LT(html.size(), 4'000'000U);
}

TEST(Report, OfNothingIsStillAPage) {
  const FakePlotly plotly;
  const std::string html = RenderReport(ReportData(), plotly.path());
  EXPECT_THAT(html, HasSubstr("</html>"));
  EXPECT_THAT(html, Not(HasSubstr("id=\"scene\"")));
}

TEST(Report, RefusesASeriesOfUnequalLengths) {
  const FakePlotly plotly;
  ReportData data = SmallReport();
  data.errors.front().values.pop_back();
  EXPECT_THROW(RenderReport(data, plotly.path()), CheckError);
}

}  // namespace
}  // namespace regolith
