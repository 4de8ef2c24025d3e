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
  data.ape = ErrorStatistics();
  data.ape->rmse = 0.0625;
  data.error = ReportSeries{"error, m", {0.0, 0.1, 0.2}, {0.01, std::nan(""), 0.03}};
  data.map = {{{1.0F, 2.0F, 3.0F}, 3.0F}, {{4.0F, 5.0F, 6.5F}, 6.5F}};
  data.stages = {{"deskew", 1.5, 2.5}};
  data.status = {{"inliers", {0.0, 1.0}, {900.0, 950.0}}};
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
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_EQ(html, RenderReport(SmallReport(), plotly.path()));
}

TEST(Report, WithoutPlotlyHasTablesAndSaysWhy) {
  const std::string html = RenderReport(SmallReport(), "/nowhere/plotly.min.js");
  EXPECT_THAT(html, HasSubstr("plotly.min.js was not found at /nowhere/plotly.min.js"));
  EXPECT_THAT(html, HasSubstr("0.0625 m"));
  EXPECT_THAT(html, HasSubstr("deskew"));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
}

TEST(Report, ThinsALargeMapAndSaysSo) {
  const FakePlotly plotly;
  ReportData data = SmallReport();
  data.map.resize(250000);
  const std::string html = RenderReport(data, plotly.path());
  EXPECT_THAT(html, HasSubstr("thinned to 100000 of its 250000 points"));
  EXPECT_LT(html.size(), 2'000'000U);
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
  data.error->values.pop_back();
  EXPECT_THROW(RenderReport(data, plotly.path()), CheckError);
}

}  // namespace
}  // namespace regolith
