// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/ros_node_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/core/error.h"

namespace regolith {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string ErrorOf(const std::string& text) {
  try {
    LoadSlamNode(YamlDocument::FromText(text, "/regolith"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RosNodeConfig, WhatIsWrittenReadsBack) {
  SlamNodeOptions options;
  options.rig = "rover.yaml";
  options.live.max_scans = 7;
  options.live.merger.hold = 0.25;
  const std::string text = WriteSlamNode(options);
  EXPECT_EQ(WriteSlamNode(LoadSlamNode(YamlDocument::FromText(text, "node"))), text);
  const std::string sim = WriteSimNode({});
  EXPECT_EQ(WriteSimNode(LoadSimNode(YamlDocument::FromText(sim, "node"))), sim);
}

TEST(RosNodeConfig, SaysWhichParameterIsWrong) {
  EXPECT_THAT(ErrorOf("pipelin: lio"), AllOf(HasSubstr("/regolith"), HasSubstr("pipeline")));
  EXPECT_THAT(ErrorOf("map_period: often"), HasSubstr("map_period"));
  EXPECT_THAT(ErrorOf("tf_rate: -1"), HasSubstr("/regolith"));
}

TEST(RosNodeConfig, SaysThatTheSimulatorHasNoSuchCamera) {
  const auto load = [](const std::string& text) {
    LoadSimNode(YamlDocument::FromText(text, "/regolith_sim"));
  };
  EXPECT_NO_THROW(load("camera: left"));
  EXPECT_NO_THROW(load("camera: ''"));
  try {
    load("camera: top");
    FAIL() << "a camera that does not exist was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("/regolith_sim"), HasSubstr("camera=top"), HasSubstr("mono")));
  }
}

}  // namespace
}  // namespace regolith
