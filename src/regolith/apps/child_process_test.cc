// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>

#include "regolith/io/text_input.h"

namespace regolith {
namespace {

using ::testing::HasSubstr;

class ChildProcessTest : public ::testing::Test {
 protected:
  void SetUp() override {
    log_ = ::testing::TempDir() + "child" + std::to_string(::getpid()) + ".log";
    std::remove(log_.c_str());
  }
  void TearDown() override { std::remove(log_.c_str()); }

  ChildResult Shell(const std::string& script, double timeout = 60.0) const {
    return RunChild({"sh", "-c", script}, log_, timeout);
  }

  std::string log_;
};

TEST_F(ChildProcessTest, GivesExitCodeOutputAndTimes) {
  const ChildResult good = Shell("echo out; echo err >&2; sleep 0.1");
  EXPECT_TRUE(good.Succeeded());
  EXPECT_EQ(ReadFile(log_), "out\nerr\n");
  EXPECT_GT(good.wall_seconds, 0.09);
  EXPECT_LT(good.cpu_seconds, good.wall_seconds);
  EXPECT_EQ(Shell("exit 3").exit_code, 3);
  EXPECT_EQ(RunChild({"/nowhere/program"}, log_, 1.0).exit_code, 127);
}

TEST_F(ChildProcessTest, SaysWhyACommandFailed) {
  const ChildResult failed = Shell("echo 'error: first'; echo 'error: rig.yaml: no'; exit 2");
  EXPECT_EQ(FailureReason(failed, log_), "rig.yaml: no");
  std::remove(log_.c_str());
  EXPECT_EQ(FailureReason(Shell("exit 7"), log_), "exit code 7");
  std::remove(log_.c_str());
  EXPECT_EQ(FailureReason(Shell("echo Traceback:; echo 'ImportError: torch'; echo; exit 1"), log_),
            "exit code 1: ImportError: torch");
  EXPECT_THAT(FailureReason(Shell("kill -SEGV $$"), log_), HasSubstr("ended by a signal: Segm"));
}

TEST_F(ChildProcessTest, EndsWhatTakesTooLong) {
  const ChildResult late = RunChild({"sleep", "30"}, log_, 0.2);
  EXPECT_TRUE(late.timed_out);
  EXPECT_LT(late.wall_seconds, 5.0);
  EXPECT_THAT(FailureReason(late, log_), HasSubstr("took longer than"));
}

}  // namespace
}  // namespace regolith
