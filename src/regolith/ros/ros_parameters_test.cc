// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "regolith/config/rig_config.h"
#include "regolith/core/error.h"
#include "regolith/ros/node_setup.h"
#include "regolith/ros/ros_parameters_internal.h"

namespace regolith {
namespace {

using testing::HasSubstr;

TEST(RosParameters, BecomeYaml) {
  XmlRpc::XmlRpcValue value;
  value["flag"] = true;
  value["count"] = 3;
  value["size"] = 0.25;
  value["name"] = std::string("a \"b\": c");
  value["nested"]["list"][0] = 1;
  value["nested"]["list"][1] = 2.5;
  EXPECT_EQ(YamlOfParameter(value),
            "{\"count\": 3, \"flag\": true, \"name\": \"a \\\"b\\\": c\", "
            "\"nested\": {\"list\": [1, 2.5]}, \"size\": 0.25}");
}

/// A rig file of a lidar and an IMU that goes with the test.
class RigFile {
 public:
  RigFile() : path_((std::filesystem::temp_directory_path() / "regolith_rig_XXXXXX").string()) {
    close(mkstemp(path_.data()));
    RigCalibration rig;
    rig.gravity = 1.62;
    rig.imu.emplace();
    rig.lidar.emplace();
    std::ofstream(path_) << WriteRig(rig);
  }
  ~RigFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string ErrorOf(const std::string& parameters, const std::string& settings = "") {
  try {
    ResolveNodeSetup("/regolith", parameters, settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(NodeSetup, ResolvesWhatThePipelineReads) {
  const RigFile rig;
  const NodeSetup setup = ResolveNodeSetup("/regolith", "{rig: " + rig.path() + ", pipeline: lio}",
                                           "{lio: {scan_voxel_size: 0.7}}");
  EXPECT_EQ(setup.pipeline.lio.scan_voxel_size, 0.7);
  ASSERT_EQ(setup.topics.size(), 2U);
  EXPECT_EQ(setup.topics[0].sensor, "imu");
  EXPECT_EQ(setup.topics[1].sensor, "lidar");
  ThreadPool threads(1);
  EXPECT_NE(MakeSlamSystem(setup, &threads), nullptr);
}

TEST(NodeSetup, SaysWhichParameterIsWrong) {
  const RigFile rig;
  EXPECT_THAT(ErrorOf("{}"), HasSubstr("/regolith/rig"));
  EXPECT_THAT(ErrorOf("{rig: /no/such.yaml, rig_timeout: 0}"), HasSubstr("/no/such.yaml"));
  EXPECT_THAT(ErrorOf("{rig: " + rig.path() + ", pipeline: nonsense}"), HasSubstr("nonsense"));
  EXPECT_THAT(ErrorOf("{rig: " + rig.path() + ", pipelin: lio}"), HasSubstr("pipelin"));
  EXPECT_THAT(ErrorOf("{rig: " + rig.path() + "}", "{lio: {voxel: 1}}"),
              HasSubstr("/regolith/settings"));
}

}  // namespace
}  // namespace regolith
