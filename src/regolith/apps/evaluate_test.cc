// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "regolith/core/error.h"
#include "regolith/geometry/so3.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/text_input.h"
#include "regolith/io/tum.h"

namespace regolith {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class EvaluateTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = ::testing::TempDir() + "evaluate" + std::to_string(::getpid());
    std::filesystem::create_directories(folder_ + "/a");
    arguments_.reference = Write("truth.tum", 0.0, 120);
    arguments_.estimates = {Write("a/trajectory.tum", 0.1, 120)};
    arguments_.out = folder_ + "/out";
    arguments_.quiet = true;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A curve of 0.2 m steps, bent by `error` metres.
  std::string Write(const std::string& name, double error, int count) const {
    std::vector<StampedPose> poses;
    for (int i = 0; i < count; ++i) {
      const double angle = 0.02 * i;
      const Eigen::Vector3d position(10.0 * std::sin(angle), 10.0 - 10.0 * std::cos(angle),
                                     error * std::sin(0.3 * i));
      poses.push_back({FromSeconds(5.0 + 0.1 * i), SE3(ExpSo3({0, 0, angle}), position)});
    }
    const std::string path = folder_ + "/" + name;
    WriteTum(path, poses);
    return path;
  }

  std::string ErrorOf(const EvaluateArguments& arguments) const {
    try {
      Evaluate(arguments);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::string folder_;
  EvaluateArguments arguments_;
};

TEST_F(EvaluateTest, WritesTheMetricsOfOneEstimateByThemselves) {
  EXPECT_EQ(Evaluate(arguments_), 0);
  const auto metrics = nlohmann::json::parse(ReadFile(arguments_.out + "/metrics.json"));
  EXPECT_EQ(metrics["matched"], 120);
  EXPECT_NEAR(metrics["length_m"], 0.2 * 119, 0.01);
  EXPECT_NEAR(metrics["ape"]["rmse"], 0.1 / std::sqrt(2.0), 0.005);
  for (const char* key : {"rmse", "mean", "median", "std", "min", "max", "sse"}) {
    for (const char* group : {"ape", "rpe", "rpe_10m", "x_m", "y_m", "z_m", "yaw_deg"}) {
      EXPECT_TRUE(metrics[group][key].is_number()) << group << "." << key;
    }
  }
  for (const char* key : {"percent_of_distance", "drift_percent", "rotation_deg_per_m",
                          "rotation_deg", "scale", "fitted_scale", "time_coverage"}) {
    EXPECT_TRUE(metrics[key].is_number()) << key;
  }
  const std::string csv = ReadFile(arguments_.out + "/metrics.csv");
  EXPECT_THAT(csv, StartsWith("estimate,matched,length_m,ape_rmse,"));
  EXPECT_THAT(csv, HasSubstr("\ntrajectory,120,"));
  EXPECT_THAT(csv, HasSubstr(",yaw_deg_rmse,"));
  EXPECT_THAT(ReadFile(arguments_.out + "/metrics.tex"), HasSubstr("\ntrajectory & 23.7"));
  EXPECT_THAT(ReadFile(arguments_.out + "/metrics.txt"), HasSubstr("APE RMSE"));
  EXPECT_TRUE(std::filesystem::exists(arguments_.out + "/trajectory.gp"));
  EXPECT_FALSE(std::filesystem::exists(arguments_.out + "/timing.gp"));
  EXPECT_TRUE(std::filesystem::exists(arguments_.out + "/ape.dat"));
}

TEST_F(EvaluateTest, NamesSeveralEstimatesApart) {
  std::filesystem::create_directories(folder_ + "/b");
  arguments_.estimates.push_back(Write("b/trajectory.tum", 0.2, 30));
  EXPECT_EQ(Evaluate(arguments_), 0);
  const auto metrics = nlohmann::json::parse(ReadFile(arguments_.out + "/metrics.json"));
  EXPECT_EQ(metrics["estimates"]["a/trajectory"]["matched"], 120);
  EXPECT_EQ(metrics["estimates"]["b/trajectory"]["matched"], 30);
  EXPECT_TRUE(metrics["estimates"]["b/trajectory"]["drift_percent"].is_null());
}

TEST_F(EvaluateTest, MarksTheBestOfSeveralAndEscapesTheirNames) {
  arguments_.estimates.push_back(Write("a/50%_worse.tum", 0.2, 120));
  EXPECT_EQ(Evaluate(arguments_), 0);
  const std::string table = ReadFile(arguments_.out + "/metrics.tex");
  EXPECT_THAT(table, HasSubstr("\\textbf{0.0698}"));
  EXPECT_THAT(table, HasSubstr("50\\%\\_worse & "));
}

TEST_F(EvaluateTest, ShowsTheTimesOfTheRunThatAnEstimateCameFrom) {
  WriteFile(folder_ + "/a/timing.csv",
            "time_s,stage,milliseconds\n5.0,deskew,1\n5.0,match,2.5\n5.1,match,4\n");
  EXPECT_EQ(Evaluate(arguments_), 0);
  EXPECT_THAT(ReadFile(arguments_.out + "/timing.dat"),
              HasSubstr("\n1 3.5 3.625 3.75 3.875 4  # trajectory\n"));
}

TEST_F(EvaluateTest, SaysWhatIsWrong) {
  EvaluateArguments wrong = arguments_;
  wrong.align = "so3";
  EXPECT_THAT(ErrorOf(wrong), HasSubstr("expected se3, sim3, yaw, origin or none"));
  wrong = arguments_;
  wrong.max_difference = -1.0;
  EXPECT_THAT(ErrorOf(wrong), HasSubstr("--max-difference"));
  wrong = arguments_;
  wrong.reference = folder_ + "/nothing.tum";
  EXPECT_THAT(ErrorOf(wrong), HasSubstr("nothing.tum"));
  wrong = arguments_;
  wrong.estimates.push_back(wrong.estimates.front());
  EXPECT_THAT(ErrorOf(wrong), HasSubstr("names a file twice"));

  EXPECT_EQ(Evaluate(arguments_), 0);
  EXPECT_THAT(ErrorOf(arguments_), HasSubstr("is not empty"));
}

}  // namespace
}  // namespace regolith
