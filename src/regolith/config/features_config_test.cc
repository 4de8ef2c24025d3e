// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/features_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/core/error.h"

namespace regolith {
namespace {

using testing::AllOf;
using testing::HasSubstr;

FeatureOptions Load(const std::string& text) {
  return LoadFeatures(YamlDocument::FromText(text, "features.yaml"));
}

std::string ErrorOf(const std::string& text) {
  try {
    Load(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Every option another than its default, so that a key that is forgotten shows.
FeatureOptions AllChanged() {
  FeatureOptions options;
  options.frontend = "orb";
  options.max_keypoints = 321;
  options.min_distance = 9;
  options.nms_radius = 5;
  options.border = 6;
  options.redetect_share = 0.7;
  options.adaptive = {false, 64, 0.03, 0.005, 1.5, 0.75, 0.25};
  options.network = {"models/other.yaml", "bf16", 3, "/tmp/cache", true};
  options.optical_flow = {15, 2, 20, 0.75, 1e-3};
  options.orb = {6, 1.25, 25, 7};
  options.shi_tomasi = {0.02, 5};
  options.matcher = {0.9, 0.5, 60, false, false, 0.9, 0.4, false};
  options.rejection = {1.5, 0.99, 500, 14, 6, 0.3, 5.0};
  options.memory = {7, 40.0};
  return options;
}

TEST(FeaturesConfig, WrittenOptionsReadBackAsTheSame) {
  const std::string text = WriteFeatures(AllChanged());
  EXPECT_EQ(WriteFeatures(Load(text)), text);
  const std::string defaults = WriteFeatures(FeatureOptions());
  EXPECT_EQ(WriteFeatures(Load("")), defaults);
  const auto lines = [](const std::string& all) {
    std::vector<std::string> split;
    for (size_t begin = 0, end = 0; begin < all.size(); begin = end + 1) {
      end = all.find('\n', begin);
      split.push_back(all.substr(begin, end - begin));
    }
    return split;
  };
  const std::vector<std::string> changed_lines = lines(text);
  const std::vector<std::string> default_lines = lines(defaults);
  ASSERT_EQ(changed_lines.size(), default_lines.size());
  for (size_t i = 0; i < changed_lines.size(); ++i) {
    if (changed_lines[i].back() == ':') continue;
    EXPECT_NE(changed_lines[i], default_lines[i]);
  }
}

TEST(FeaturesConfig, TheCommandLineReachesEveryLevel) {
  YamlDocument document = YamlDocument::Empty("command line");
  document.Set("features.precision=bf16");
  document.Set("features.matcher.ratio=0.8");
  const FeatureOptions options = LoadFeatures(document);
  EXPECT_EQ(options.network.precision, "bf16");
  EXPECT_EQ(options.matcher.ratio, 0.8);
}

TEST(FeaturesConfig, UnknownKeysAndFrontendsAreRefused) {
  EXPECT_THAT(ErrorOf("features: {precison: f32}\n"),
              AllOf(HasSubstr("features.yaml:1"), HasSubstr("features.precison"),
                    HasSubstr("did you mean `precision`")));
  EXPECT_THAT(ErrorOf("features: {}\nlio: {}\n"), HasSubstr("features.yaml:2: lio"));
  EXPECT_THAT(ErrorOf("features: {frontend: sift}\n"),
              AllOf(HasSubstr("features.frontend"), HasSubstr("sift"), HasSubstr("superpoint")));
}

TEST(FeaturesConfig, ImpossibleValuesAreRefusedWithTheFile) {
  EXPECT_THAT(ErrorOf("features: {max_keypoints: 0}\n"),
              AllOf(HasSubstr("features.yaml"), HasSubstr("max_keypoints=0")));
  EXPECT_THAT(ErrorOf("features: {precision: f16}\n"),
              AllOf(HasSubstr("precision=f16"), HasSubstr("bf16")));
  EXPECT_THAT(ErrorOf("features: {orb: {levels: many}}\n"), HasSubstr("features.orb.levels"));
}

}  // namespace
}  // namespace regolith
