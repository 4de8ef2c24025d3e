// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/ros/topic_input.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sensor_msgs/Image.h>

#include "regolith/io/ros1_test_messages_internal.h"
#include "regolith/system/event_merger.h"

namespace regolith {
namespace {

using testing::HasSubstr;

RigCalibration Rig() {
  RigCalibration rig;
  rig.imu.emplace();
  rig.lidar.emplace();
  CameraCalibration& camera = rig.cameras["mono"];
  camera.topic = "/camera/image_raw";
  camera.intrinsics.width = 8;
  camera.intrinsics.height = 6;
  rig.wheels.emplace();
  return rig;
}

class TopicInputTest : public testing::Test {
 protected:
  TopicInput Input(const std::string& sensor) const {
    for (const SensorTopic& topic : SensorsOf(rig_)) {
      if (topic.sensor == sensor) return {topic, rig_};
    }
    throw std::logic_error(sensor);
  }

  static sensor_msgs::Image Picture() {
    sensor_msgs::Image image;
    image.header.stamp = ros::Time(100.0);
    image.width = 8;
    image.height = 6;
    image.step = 8;
    image.encoding = "mono8";
    image.data.assign(48, 7);
    return image;
  }

  static sensor_msgs::PointCloud2 Cloud() {
    LidarScan scan;
    scan.stamp = FromSeconds(100.0);
    for (int i = 0; i < 100; ++i) {
      LidarPoint point;
      point.position = {5.0F, 0.01F * static_cast<float>(i), 0.0F};
      scan.points.push_back(point);
    }
    return ToRos(scan);
  }

  template <typename Message>
  static bool Takes(TopicInput* input, const std::string& type, const Message& message) {
    return input->Receive(type, Serialize(message), 1.0).has_value();
  }

  /// The input goes on after a message that it could not read, and has said why.
  template <typename Message>
  static void ExpectDropped(TopicInput* input, const std::string& type, const Message& bad,
                            const Message& good, const std::string& reason) {
    EXPECT_FALSE(Takes(input, type, bad));
    const TopicStatus status = input->Status(1.0);
    EXPECT_EQ(status.dropped, 1U);
    std::string said = status.problem;
    for (const std::string& notice : status.notices) said += notice;
    EXPECT_THAT(said, HasSubstr(reason));
    EXPECT_TRUE(Takes(input, type, good));
    EXPECT_EQ(input->Status(1.0).messages, 2U);
    EXPECT_EQ(input->Status(1.0).problem, "");
  }

  RigCalibration rig_ = Rig();
};

constexpr const char* kImage = "sensor_msgs/Image";
constexpr const char* kCloud = "sensor_msgs/PointCloud2";
constexpr const char* kImuType = "sensor_msgs/Imu";

TEST_F(TopicInputTest, AnImageWithoutPixelsIsDropped) {
  TopicInput input = Input("mono");
  sensor_msgs::Image empty = Picture();
  empty.width = empty.height = empty.step = 0;
  empty.data.clear();
  ExpectDropped(&input, kImage, empty, Picture(), "do not agree");
}

TEST_F(TopicInputTest, AnImageOfAnotherSizeThanTheRigSaysIsDropped) {
  TopicInput input = Input("mono");
  sensor_msgs::Image wide = Picture();
  wide.width = wide.step = 16;
  wide.data.resize(96);
  ExpectDropped(&input, kImage, wide, Picture(), "16 x 6");
}

TEST_F(TopicInputTest, ACloudWhoseStepsLieIsDropped) {
  for (const uint32_t lie : {0U, 7U, 0xffffffffU}) {
    TopicInput input = Input("lidar");
    sensor_msgs::PointCloud2 bad = Cloud();
    bad.row_step = lie;
    if (lie == 0U) bad.point_step = 0;
    ExpectDropped(&input, kCloud, bad, Cloud(), "message");
  }
}

TEST_F(TopicInputTest, ACloudWithAHugeCountOfPointsIsDropped) {
  TopicInput input = Input("lidar");
  sensor_msgs::PointCloud2 bad = Cloud();
  bad.width = 4000000000U;
  bad.height = 4000000000U;
  ExpectDropped(&input, kCloud, bad, Cloud(), "message");
}

TEST_F(TopicInputTest, PointsThatAreNoNumbersAreDroppedAndCounted) {
  TopicInput input = Input("lidar");
  sensor_msgs::PointCloud2 cloud = Cloud();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (size_t i = 0; i < 10; ++i) std::memcpy(&cloud.data[i * cloud.point_step], &nan, sizeof(nan));
  const auto event = input.Receive(kCloud, Serialize(cloud), 1.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(std::get<LidarScan>(*event).points.size(), 90U);
  const std::vector<std::string> notices = input.Status(1.0).notices;
  EXPECT_THAT(notices, testing::Contains(HasSubstr("10 points dropped")));
}

TEST_F(TopicInputTest, ImuValuesThatAreNoNumbersAreDropped) {
  TopicInput input = Input("imu");
  ImuSample sample;
  sample.time = FromSeconds(100.0);
  sensor_msgs::Imu bad = ToRos(sample);
  bad.linear_acceleration.z = std::numeric_limits<double>::quiet_NaN();
  ExpectDropped(&input, kImuType, bad, ToRos(sample), "not finite");
}

TEST_F(TopicInputTest, BytesThatEndEarlyAreDropped) {
  for (const char* const sensor : {"imu", "lidar", "mono", "wheels"}) {
    TopicInput input = Input(sensor);
    const std::string type = input.types().front();
    for (const size_t size : {size_t{0}, size_t{3}, size_t{16}, size_t{40}}) {
      EXPECT_FALSE(input.Receive(type, std::vector<uint8_t>(size, 0xff), 1.0));
    }
    EXPECT_EQ(input.Status(1.0).dropped, 4U);
  }
}

TEST_F(TopicInputTest, StampsOfZeroOrOfTheFutureAreDroppedOnTheWay) {
  TopicInput input = Input("imu");
  EventMerger merger(1, {});
  const auto push = [&](double seconds) {
    ImuSample sample;
    sample.time = FromSeconds(seconds);
    auto event = input.Receive(kImuType, Serialize(ToRos(sample)), 1.0);
    ASSERT_TRUE(event);
    merger.Add(0, std::move(*event));
  };
  push(100.0);
  push(0.0);
  push(4.0e9);
  push(100.1);
  EXPECT_EQ(merger.dropped(0).no_stamp, 1U);
  EXPECT_EQ(merger.dropped(0).astray, 1U);
  EXPECT_EQ(merger.TakeAll().size(), 2U);
}

TEST_F(TopicInputTest, ATopicOfAnotherTypeSaysWhatWasExpected) {
  TopicInput input = Input("wheels");
  EXPECT_FALSE(input.Receive("geometry_msgs/Twist", std::vector<uint8_t>(48), 1.0));
  EXPECT_THAT(input.Status(1.0).problem, HasSubstr("geometry_msgs/Twist"));
  EXPECT_THAT(input.Status(1.0).problem, HasSubstr("nav_msgs/Odometry"));
}

TEST_F(TopicInputTest, SaysHowOftenAndWhen) {
  TopicInput input = Input("imu");
  EXPECT_FALSE(input.Status(0.0).age);
  ImuSample sample;
  for (int i = 0; i < 300; ++i) {
    sample.time = FromSeconds(100.0 + 0.01 * i);
    input.Receive(kImuType, Serialize(ToRos(sample)), 0.01 * i);
  }
  EXPECT_NEAR(input.Status(3.0).rate, 100.0, 1.0);
  EXPECT_NEAR(*input.Status(5.0).age, 2.01, 1e-9);
}

TEST_F(TopicInputTest, SkippedMessagesAreDroppedAndSaid) {
  TopicInput input = Input("lidar");
  input.Skip(1.0);
  EXPECT_EQ(input.Status(1.0).messages, 1U);
  EXPECT_EQ(input.Status(1.0).dropped, 1U);
  EXPECT_THAT(input.Status(1.0).notices, testing::Contains(HasSubstr("faster")));
}

TEST_F(TopicInputTest, ListensToCompressedImagesToo) {
  EXPECT_THAT(Input("mono").Topics(),
              testing::ElementsAre("/camera/image_raw", "/camera/image_raw/compressed"));
  EXPECT_THAT(Input("imu").Topics(), testing::ElementsAre("/imu/data"));
  TopicInput input = Input("mono");
  CameraFrame frame;
  frame.time = FromSeconds(100.0);
  frame.image.width = 8;
  frame.image.height = 6;
  frame.image.data.assign(48, 3);
  EXPECT_TRUE(Takes(&input, "sensor_msgs/CompressedImage", ToRos(frame)));
  EXPECT_TRUE(Takes(&input, kImage, Picture()));
}

}  // namespace
}  // namespace regolith
