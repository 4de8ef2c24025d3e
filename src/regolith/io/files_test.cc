// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "regolith/core/error.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/ply.h"
#include "regolith/io/test_folder.h"
#include "regolith/io/text_input.h"
#include "regolith/io/tum.h"

namespace regolith {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

template <typename Error, typename Function>
std::string ErrorOf(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// Files cannot grow past `bytes` while it lives: what a full disk looks like to a program.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TestFolder folder;
  const std::string path = folder.Path("file.txt");
  {
    AtomicFile file(path);
    file.Write("half");
    EXPECT_FALSE(fs::exists(path));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
  AtomicFile file(path);
  file.Write("whole");
  file.Commit();
  EXPECT_EQ(ReadFile(path), "whole");
}

TEST(AtomicFile, MarksPartialOutput) {
  const TestFolder folder;
  AtomicFile file(folder.Path("map.ply"));
  file.Write("some");
  file.Commit(true);
  EXPECT_FALSE(fs::exists(folder.Path("map.ply")));
  EXPECT_EQ(ReadFile(folder.Path("map.partial.ply")), "some");
}

TEST(AtomicFile, FullDiskIsAnOutputErrorAndLeavesNothing) {
  const TestFolder folder;
  const std::string path = folder.Path("file.bin");
  const FullDisk full(10000);
  for (const size_t size : {size_t{12000}, size_t{1000000}}) {
    const std::string error =
        ErrorOf<OutputError>([&] { WriteFile(path, std::string(size, 'x')); });
    EXPECT_THAT(error, HasSubstr(path));
    EXPECT_TRUE(fs::is_empty(folder.path())) << size;
  }
}

TEST(AtomicFile, UnwritablePlacesAreNamed) {
  EXPECT_THAT(ErrorOf<OutputError>([] { AtomicFile file("/no/such/folder/file.txt"); }),
              HasSubstr("no folder /no/such/folder"));
  EXPECT_THAT(ErrorOf<OutputError>([] { AtomicFile file("/proc/file.txt"); }),
              HasSubstr("/proc/file.txt: cannot be written"));
  const TestFolder folder;
  EXPECT_THAT(ErrorOf<OutputError>([&] { AtomicFile file(folder.path()); }), HasSubstr("folder"));
}

TEST(Tum, ReadsStampsExactly) {
  const TestFolder folder;
  const std::string path = folder.Path("a.tum");
  WriteFile(path,
            "# a comment\n1403636580.838555648 1 2 3 0 0 0 1\r\n\n"
            "1403636580.838555647 1.5e0 -2 3 0 0 0.70711 0.70711\n-0.25 0 0 0 0 0 0 -1\n");
  const auto poses = ReadTum(path);
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].time, 1403636580838555648);
  EXPECT_EQ(poses[1].time, 1403636580838555647);
  EXPECT_EQ(poses[2].time, -250000000);
  EXPECT_EQ(poses[1].T_world_body.translation, Eigen::Vector3d(1.5, -2.0, 3.0));
  EXPECT_NEAR(poses[1].T_world_body.rotation.norm(), 1.0, 1e-12);
}

TEST(Tum, RoundTripKeepsEveryNanosecond) {
  const TestFolder folder;
  const std::string path = folder.Path("a.tum");
  std::vector<StampedPose> poses(3);
  poses[0].time = -1;
  poses[1].time = 1403636580838555648;
  poses[1].T_world_body = {Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {1e-9, -123.456789, 1e6}};
  poses[2].time = 7;
  WriteTum(path, poses);
  const auto read = ReadTum(path);
  ASSERT_EQ(read.size(), 3U);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read[i].time, poses[i].time);
    EXPECT_NEAR((read[i].T_world_body.translation - poses[i].T_world_body.translation).norm(), 0.0,
                1e-9);
    EXPECT_NEAR(read[i].T_world_body.rotation.angularDistance(poses[i].T_world_body.rotation), 0.0,
                1e-8);
  }
  EXPECT_EQ(TumLine(poses[0]),
            "-0.000000001 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
            "0.000000000 1.000000000\n");
}

TEST(Tum, ErrorsNameTheLine) {
  const TestFolder folder;
  const std::string path = folder.Path("a.tum");
  const auto error = [&](const std::string& line) {
    WriteFile(path, "# comment\n1 0 0 0 0 0 0 1\n" + line + "\n");
    return ErrorOf<InputError>([&] { ReadTum(path); });
  };
  EXPECT_THAT(error("2 0 0 0 0 0 1"), HasSubstr("a.tum:3: has 7 columns"));
  EXPECT_THAT(error("2 0 0 nan 0 0 0 1"), HasSubstr("a.tum:3: column 4"));
  EXPECT_THAT(error("2 0 0 0 0 0 0 0.5"), HasSubstr("a.tum:3: quaternion has length 0.5"));
  EXPECT_THAT(error("x 0 0 0 0 0 0 1"), HasSubstr("a.tum:3: stamp 'x'"));
  EXPECT_THAT(error("2 0 0 0,1 0 0 0 1"), HasSubstr("a.tum:3: column 4"));
  EXPECT_THAT(ErrorOf<InputError>([] { ReadTum("/no/file.tum"); }), HasSubstr("/no/file.tum"));
  EXPECT_THAT(ErrorOf<InputError>([&] { ReadTum(folder.path()); }), HasSubstr("is a folder"));
}

TEST(TextInput, ParsesDates) {
  EXPECT_EQ(ParseDate("1970-01-02 00:00:01.5"), 86401500000000);
  EXPECT_EQ(ParseDate("2011-09-26 13:04:32.351950336"), 1317042272351950336);
  EXPECT_EQ(*ParseDate("2012-03-01 00:00:00") - *ParseDate("2012-02-28 23:59:59.999999999"),
            86400 * 1000000000LL + 1);
  EXPECT_FALSE(ParseDate("2011-13-26 13:04:32"));
  EXPECT_FALSE(ParseDate("yesterday"));
}

TEST(TextInput, ParsesSeconds) {
  EXPECT_EQ(ParseSeconds("0.0000000005"), 1);
  EXPECT_EQ(ParseSeconds("1e-3"), 1000000);
  EXPECT_EQ(ParseSeconds(".5"), 500000000);
  EXPECT_FALSE(ParseSeconds(""));
  EXPECT_FALSE(ParseSeconds("nan"));
  EXPECT_FALSE(ParseSeconds("1.2.3"));
  EXPECT_FALSE(ParseSeconds("99999999999999999999"));
}

TEST(Ply, RoundTrip) {
  const TestFolder folder;
  const std::string path = folder.Path("map.ply");
  const std::vector<MapPoint> points = {{{1.0F, -2.0F, 3.5F}, 0.25F}, {{4.0F, 5.0F, 6.0F}, 7.0F}};
  WritePly(path, points);
  const auto read = ReadPly(path);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].position, points[1].position);
  EXPECT_EQ(read[0].intensity, 0.25F);
}

TEST(Ply, ReadsOtherTypesAndRefusesDamage) {
  const TestFolder folder;
  const std::string path = folder.Path("map.ply");
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar red\n"
      "property double x\nproperty double y\nproperty double z\nend_header\n";
  bytes.push_back('\x7f');
  for (const double value : {1.5, 2.5, -3.5}) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  WriteFile(path, bytes);
  EXPECT_EQ(ReadPly(path).at(0).position, Eigen::Vector3f(1.5F, 2.5F, -3.5F));
  for (size_t length = 0; length < bytes.size(); ++length) {
    WriteFile(path, bytes.substr(0, length));
    EXPECT_THROW(ReadPly(path), InputError) << length;
  }
}

}  // namespace
}  // namespace regolith
