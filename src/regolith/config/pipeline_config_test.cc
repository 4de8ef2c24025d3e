// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/pipeline_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "regolith/core/error.h"

namespace regolith {
namespace {

TEST(PipelineConfig, WrittenOptionsReadBackAsTheSame) {
  PipelineOptions options;
  options.name = "lio";
  options.lio.map.voxel_size = 0.7;
  options.lio.imu = false;
  options.map.max_points = 123;
  const std::string text = WritePipeline(options);
  const PipelineOptions copy = LoadPipeline(YamlDocument::FromText(text, "pipeline.yaml"));
  EXPECT_EQ(WritePipeline(copy), text);
  EXPECT_FALSE(copy.lio.imu);
}

TEST(PipelineConfig, EveryShippedPipelineLoadsUnderItsName) {
  const std::filesystem::path folder = std::string(REGOLITH_SOURCE_DIR) + "/config/pipelines";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_EQ(LoadPipeline(YamlDocument::FromFile(entry.path())).name, entry.path().stem());
    ++count;
  }
  EXPECT_GE(count, 1);
}

TEST(PipelineConfig, ImpossibleValuesAreRefusedWithTheFile) {
  try {
    LoadPipeline(YamlDocument::FromText("lio: {map: {voxel_size: -1}}\n", "pipeline.yaml"));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("voxel_size=-1"));
    EXPECT_THAT(error.what(), testing::HasSubstr("pipeline.yaml"));
  }
}

}  // namespace
}  // namespace regolith
