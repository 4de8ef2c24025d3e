// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/feature_setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/config/test_folder_internal.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

using testing::HasSubstr;

std::string WriteModel(const TestFolder& folder) {
  WriteFile(folder.Path("net.onnx"), "a network");
  WriteFile(folder.Path("net.yaml"),
            "name: net\nfile: net.onnx\nsha256: " + std::string(64, 'a') +
                "\ninput: {name: image, shape: [1, 1, -1, -1]}\n"
                "outputs:\n"
                "  logits: {name: logits, shape: [1, 65, -1, -1]}\n"
                "  descriptors: {name: descriptors, shape: [1, 64, -1, -1]}\n"
                "normalisation: {mean: 0, scale: 1, per_image: false}\n");
  return folder.Path("net.yaml");
}

TEST(FeatureSetup, NetworksGetTheModelThatIsAskedForAndACache) {
  const TestFolder folder;
  FeatureOptions options;
  options.frontend = "ghost_lk";
  options.network.model = WriteModel(folder);
  const auto manifest = PrepareModel(&options);
  ASSERT_TRUE(manifest);
  EXPECT_EQ(manifest->path, folder.Path("net.onnx"));
  EXPECT_THAT(options.network.cache, HasSubstr("models"));
  options.network.cache = folder.path();
  PrepareModel(&options);
  EXPECT_EQ(options.network.cache, folder.path());
}

TEST(FeatureSetup, OtherFrontendsRunNoNetwork) {
  FeatureOptions options;
  for (const char* frontend : {"orb", "st_lk"}) {
    options.frontend = frontend;
    options.network.model.clear();
    EXPECT_FALSE(PrepareModel(&options));
    options.network.model = "ghost";
    try {
      PrepareModel(&options);
      FAIL() << "no error";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("features.model"));
    }
  }
}

}  // namespace
}  // namespace regolith
