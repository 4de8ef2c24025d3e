// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/recording_info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include <cmath>
#include <filesystem>

#include "regolith/core/error.h"
#include "regolith/io/ros1_conversions_internal.h"
#include "regolith/io/test_folder.h"

namespace regolith {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr TimeNs kMillisecond = 1000000;

RigCalibration MakeRig() {
  RigCalibration rig;
  rig.imu.emplace();
  rig.lidar.emplace();
  CameraCalibration camera;
  camera.topic = "/camera/mono/image_raw";
  camera.intrinsics = {CameraModelType::kPinhole, 8, 6, {5, 5}, {3.5, 2.5}, {}};
  rig.cameras["mono"] = camera;
  return rig;
}

/// Two seconds at 200 Hz with a gap of 0.5 s, a repeat and a step back; `force` in z.
void WriteImu(double force, rosbag::Bag* bag) {
  for (TimeNs i = 0; i < 400; ++i) {
    if (i > 200 && i < 300) continue;
    const TimeNs stamp = i == 150 ? 149 : i == 160 ? 100 : i;
    const double value = i == 170 ? NAN : force;
    const ImuSample sample{stamp * 5 * kMillisecond, Eigen::Vector3d::Zero(), {0.0, 0.0, value}};
    bag->write("/imu/data", ToRosTime(i * 5 * kMillisecond + 1), ToRos(sample));
  }
}

RecordingIdentity WriteRecording(const TestFolder& folder, double force) {
  const std::string path = folder.Path("own.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  WriteImu(force, &bag);
  LidarScan scan;
  scan.has_point_times = false;
  scan.points.resize(3);
  scan.points[0].position.x() = NAN;
  bag.write("/velodyne_points", ros::TIME_MIN, ToRos(scan));
  const CameraFrame frame{5, "mono", {8, 6, std::vector<uint8_t>(48)}};
  bag.write("/camera/mono/image_raw", ros::TIME_MIN, ToRos(frame));
  bag.close();
  return IdentifyRecording(path);
}

TEST(RecordingInfo, ListsRatesGapsAndJumps) {
  const TestFolder folder;
  const RecordingInfo info = InspectRecording(WriteRecording(folder, 9.8));
  EXPECT_EQ(info.format, "ROS 1 bag");
  ASSERT_EQ(info.topics.size(), 3U);
  const TopicInfo& imu = info.topics[1];
  EXPECT_EQ(imu.name, "/imu/data");
  EXPECT_EQ(imu.messages, 301U);
  EXPECT_EQ(imu.repeated, 1U);
  EXPECT_EQ(imu.backward, 1U);
  EXPECT_NEAR(imu.largest_gap, 0.5, 1e-9);
  EXPECT_NEAR(imu.duration, 1.995, 1e-9);
  EXPECT_NEAR(imu.rest_force, 9.8, 1e-9);
  EXPECT_THAT(imu.remarks, ElementsAre(HasSubstr("1 unusable: values that are not finite")));
  EXPECT_EQ(info.topics[0].width, 8);
  EXPECT_THAT(info.topics[2].remarks,
              ElementsAre("no time", "1 points not finite in 1 clouds sampled"));
}

TEST(RecordingInfo, SaysWhetherARigFits) {
  const TestFolder folder;
  const auto identity = WriteRecording(folder, 1.0);
  const RecordingInfo info = InspectRecording(identity);
  RigCalibration rig = MakeRig();
  rig.imu->rate = 150.0;
  EXPECT_THAT(CheckRigFits(identity, info, rig), ElementsAre(HasSubstr("looks like g, not m/s^2")));
  rig.gravity = 1.0;
  EXPECT_TRUE(CheckRigFits(identity, info, rig).empty());
  rig.gravity = 3.72;
  rig.imu->rate = 400.0;
  rig.lidar->topic = "/imu/data";
  rig.cameras["mono"].intrinsics.width = 640;
  rig.wheels.emplace();
  EXPECT_THAT(CheckRigFits(identity, info, rig),
              ElementsAre(HasSubstr("imu.rate is 400"), HasSubstr("check `gravity`"),
                          HasSubstr("is of type sensor_msgs/Imu"), HasSubstr("has 640 x 6"),
                          HasSubstr("has no topic /odom")));
}

TEST(RecordingInfo, ReadsRealBags) {
  const std::string data = DataFolder() + "/bags/";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "NO REAL DATA in " << data;
  const RecordingInfo info = InspectRecording(IdentifyRecording(data + "phidgets_imu.bag"));
  ASSERT_EQ(info.topics.size(), 2U);
  EXPECT_EQ(info.topics[0].messages, 13964U);
  EXPECT_NEAR(info.topics[0].rate, 248.0, 3.0);
  EXPECT_NEAR(info.topics[0].rest_force, 9.8, 0.3);
}

}  // namespace
}  // namespace regolith
