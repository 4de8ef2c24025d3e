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

TEST(PipelineConfig, TheBackEndHasSettingsAndChecksThem) {
  const auto load = [](const std::string& text) {
    return LoadPipeline(YamlDocument::FromText(text, "pipeline.yaml"));
  };
  const PipelineOptions options = load(
      "pipeline: lio\n"
      "backend:\n"
      "  close_loops: false\n"
      "  verifier:\n"
      "    min_agreement: 0.95\n"
      "    relief:\n"
      "      cell_size: 0.4\n");
  EXPECT_FALSE(options.backend.close_loops);
  EXPECT_EQ(options.backend.verifier.min_agreement, 0.95);
  EXPECT_EQ(options.backend.verifier.relief.cell_size, 0.4);
  EXPECT_THROW(load("backend:\n  search:\n    max_candidates: 0\n"), InputError);
  EXPECT_THROW(load("backend:\n  nonsense: 1\n"), InputError);
}

TEST(PipelineConfig, LegoLoamIsAnOdometryOfItsOwn) {
  const std::string path = std::string(REGOLITH_SOURCE_DIR) + "/config/pipelines/lego_loam.yaml";
  PipelineOptions options = LoadPipeline(YamlDocument::FromFile(path));
  EXPECT_EQ(options.odometry, OdometryKind::kLegoLoam);
  options.lego_loam.keyframes.distance = 0.7;
  options.lego_loam.segmentation.ground.max_bend_deg = 9.0;
  const std::string text = WritePipeline(options);
  const PipelineOptions copy = LoadPipeline(YamlDocument::FromText(text, "pipeline.yaml"));
  EXPECT_EQ(WritePipeline(copy), text);
  EXPECT_EQ(copy.lego_loam.keyframes.distance, 0.7);
}

TEST(PipelineConfig, AnUnknownOdometryIsRefused) {
  try {
    LoadPipeline(YamlDocument::FromText("odometry: loam\n", "pipeline.yaml"));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("expected lio, lego_loam, vio or stereo"));
  }
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
