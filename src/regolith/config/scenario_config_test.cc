// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/scenario_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/core/error.h"

namespace regolith {
namespace {

std::string Refusal(const std::string& text) {
  try {
    LoadScenario(YamlDocument::FromText(text, "drive.yaml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ScenarioConfig, ReadsBackWhatItWrites) {
  ScenarioOptions options;
  options.planet = "mars";
  options.gravity = 3.72;
  options.seed = 18'000'000'000'000'000'000ULL;
  options.terrain.relief.statistic = SlopeStatistic::kRms;
  options.wheels.slip = {0.01, 0.02, 0.05, 0.2};
  const std::string text = WriteScenario(options);
  const ScenarioOptions read = LoadScenario(YamlDocument::FromText(text, "again"));
  EXPECT_EQ(read.planet, "mars");
  EXPECT_EQ(read.seed, options.seed);
  EXPECT_EQ(read.terrain.relief.statistic, SlopeStatistic::kRms);
  EXPECT_EQ(WriteScenario(read), text);
}

TEST(ScenarioConfig, ShippedScenariosLoad) {
  for (const char* name : {"lunar_short", "mars_short"}) {
    const std::string path =
        std::string(REGOLITH_SOURCE_DIR) + "/config/scenarios/" + name + ".yaml";
    EXPECT_EQ(LoadScenario(YamlDocument::FromFile(path)).duration, 40.0) << name;
  }
}

TEST(ScenarioConfig, NamesTheKeyOfWhatItRefuses) {
  EXPECT_THAT(Refusal("sun: {elevation_deg: -3}"), testing::HasSubstr("sun.elevation_deg"));
  EXPECT_THAT(Refusal("sun: {elevation_deg: -3}"), testing::HasSubstr("horizon"));
  EXPECT_THAT(Refusal("duration: 4"), testing::IsEmpty());
  EXPECT_THAT(Refusal("duration: 3.5"), testing::HasSubstr("duration"));
  EXPECT_THAT(Refusal("planet: venus"), testing::HasSubstr("moon or mars"));
  EXPECT_THAT(Refusal("driev: {speed: 1}"), testing::HasSubstr("driev"));
  EXPECT_THAT(Refusal("terrain: {relief: {statistic: mean}}"), testing::HasSubstr("median or rms"));
}

}  // namespace
}  // namespace regolith
