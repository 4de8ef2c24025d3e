// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/install_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "regolith/config/test_folder_internal.h"
#include "regolith/core/error.h"

namespace regolith {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string ErrorOf(const std::string& model) {
  try {
    FindModel(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(InstallPaths, FindsModelsByNameAndByPath) {
  const TestFolder folder;
  WriteFile(folder.Path("own.yaml"), "name: own\n");
  EXPECT_EQ(FindModel(folder.Path("own.yaml")), folder.Path("own.yaml"));
  for (const std::string& name : ModelNames()) {
    EXPECT_THAT(FindModel(name), HasSubstr("models/" + name + ".yaml"));
    EXPECT_THAT(ErrorOf("spirit"), HasSubstr(name));
  }
  EXPECT_THAT(ErrorOf("spirit"), AllOf(HasSubstr("spirit"), HasSubstr("models")));
  EXPECT_NE(ErrorOf(""), "");
  EXPECT_NE(ErrorOf(folder.path()), "");
}

TEST(InstallPaths, ListsWhatIsThereWhereAConfigIsNot) {
  try {
    FindConfig("pipelines", "nonsense");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("nonsense"), HasSubstr("lio, ")));
  }
}

TEST(InstallPaths, CachesLieWhereTheEnvironmentSays) {
  const char* const before = std::getenv("REGOLITH_CACHE");
  const std::string kept = before == nullptr ? "" : before;
  setenv("REGOLITH_CACHE", "/data/cache", 1);
  EXPECT_EQ(CacheFolder("models"), "/data/cache/models");
  setenv("REGOLITH_CACHE", "", 1);
  const char* const home = std::getenv("HOME");
  if (home != nullptr) {
    EXPECT_EQ(CacheFolder("models"), std::string(home) + "/.cache/regolith/models");
  }
  if (before != nullptr) setenv("REGOLITH_CACHE", kept.c_str(), 1);
}

}  // namespace
}  // namespace regolith
