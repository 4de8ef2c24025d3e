// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "regolith/io/bag_writer.h"
#include "regolith/io/test_folder.h"

namespace regolith {
namespace {

using testing::HasSubstr;

TEST(Info, PrintsTopicsAndWhetherTheRigFits) {
  const TestFolder folder;
  const std::string path = folder.Path("own.bag");
  RigCalibration rig;
  rig.imu.emplace();
  const auto writer = BagWriter::Create(path, rig);
  for (TimeNs i = 0; i < 400; ++i) {
    writer->Write(ImuSample{i * 5000000, Eigen::Vector3d::Zero(), {0.0, 0.0, 9.81}});
  }
  writer->Close();
  const RecordingIdentity identity = IdentifyRecording(path);
  std::ostringstream out;
  EXPECT_EQ(Info({path, ""}, std::nullopt, identity, out), 0);
  EXPECT_THAT(out.str(), HasSubstr(path + ": ROS 1 bag, 2.00 s"));
  EXPECT_THAT(out.str(), HasSubstr("/imu/data  sensor_msgs/Imu"));
  EXPECT_THAT(out.str(), HasSubstr("200.00"));
  EXPECT_EQ(Info({path, "rig.yaml"}, rig, identity, out), 0);
  EXPECT_THAT(out.str(), HasSubstr("rig.yaml fits this recording"));
  rig.gravity = 1.62;
  EXPECT_EQ(Info({path, "rig.yaml"}, rig, identity, out), 2);
  EXPECT_THAT(out.str(), HasSubstr("rig.yaml does not fit:\n  /imu/data: mean specific force"));
}

}  // namespace
}  // namespace regolith
