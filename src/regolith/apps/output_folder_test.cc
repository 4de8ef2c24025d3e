// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/output_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "regolith/core/error.h"

namespace regolith {
namespace {

namespace fs = std::filesystem;

class OutputFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("output_folder" + std::to_string(getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(OutputFolderTest, MakesFoldersAndRefusesFullOnes) {
  PrepareOutputFolder(folder_ / "a" / "b", false);
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
  PrepareOutputFolder(folder_ / "a" / "b", false);
  std::ofstream(folder_ / "a" / "b" / "file") << "x";
  EXPECT_THROW(PrepareOutputFolder(folder_ / "a" / "b", false), InputError);
  PrepareOutputFolder(folder_ / "a" / "b", true);
  EXPECT_TRUE(fs::exists(folder_ / "a" / "b" / "file"));
}

TEST_F(OutputFolderTest, RefusesFilesAndEmptyNames) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THROW(PrepareOutputFolder(folder_ / "file", true), InputError);
  EXPECT_THROW(PrepareOutputFolder(folder_ / "file" / "below", true), InputError);
  EXPECT_THROW(PrepareOutputFolder("", true), InputError);
}

}  // namespace
}  // namespace regolith
