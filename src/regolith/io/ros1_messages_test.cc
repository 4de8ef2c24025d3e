// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/ros1_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sensor_msgs/Image.h>

#include <cmath>

#include "regolith/io/ros1_test_messages_internal.h"

namespace regolith {
namespace {

using testing::HasSubstr;

constexpr TimeNs kTime = 1403636580838555648;

TEST(Ros1Messages, ImuRoundTrip) {
  const ImuSample sample{kTime, {0.1, -0.2, 0.3}, {1.0, 2.0, 9.0}};
  const auto bytes = Serialize(ToRos(sample));
  const auto result = ParseImu(bytes);
  ASSERT_TRUE(result.value) << result.problem;
  EXPECT_EQ(result.value->time, kTime);
  EXPECT_EQ(result.value->angular_velocity, sample.angular_velocity);
  EXPECT_EQ(result.value->specific_force, sample.specific_force);
  EXPECT_EQ(HeaderStamp(bytes), kTime);
  for (size_t length = 0; length < bytes.size() - 9 * sizeof(double); ++length) {
    EXPECT_FALSE(ParseImu({bytes.data(), length}).value) << length;
  }
}

TEST(Ros1Messages, ImuNonsenseIsRefused) {
  EXPECT_THAT(ParseImu(Serialize(ToRos(ImuSample{1, {NAN, 0, 0}, {0, 0, 9}}))).problem,
              HasSubstr("not finite"));
  EXPECT_THAT(ParseImu(Serialize(ToRos(ImuSample{1, {0, 0, 0}, {0, INFINITY, 9}}))).problem,
              HasSubstr("not finite"));
  EXPECT_THAT(ParseImu(Serialize(ToRos(ImuSample{1, {0, 0, 0}, {0, 0, 1e6}}))).problem,
              HasSubstr("no IMU measures"));
}

TEST(Ros1Messages, OdometryAndPoseRoundTrip) {
  WheelOdometry odometry;
  odometry.time = kTime;
  odometry.T_odom_base = {Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {1, 2, 3}};
  odometry.linear_velocity_base = {0.5, 0.01, 0.0};
  odometry.angular_velocity_base = {0.0, 0.0, 0.3};
  const auto read = ParseOdometry(Serialize(ToRos(odometry)));
  ASSERT_TRUE(read.value) << read.problem;
  EXPECT_EQ(read.value->T_odom_base.translation, odometry.T_odom_base.translation);
  EXPECT_EQ(read.value->T_odom_base.rotation.coeffs(), odometry.T_odom_base.rotation.coeffs());
  EXPECT_EQ(read.value->linear_velocity_base, odometry.linear_velocity_base);
  EXPECT_EQ(read.value->angular_velocity_base, odometry.angular_velocity_base);
  const auto pose = ParsePose(Serialize(ToRos(StampedPose{kTime, odometry.T_odom_base})));
  ASSERT_TRUE(pose.value) << pose.problem;
  EXPECT_EQ(pose.value->time, kTime);
  EXPECT_EQ(pose.value->T_world_body.translation, odometry.T_odom_base.translation);
  odometry.T_odom_base.rotation.coeffs().setZero();
  EXPECT_THAT(ParseOdometry(Serialize(ToRos(odometry))).problem, HasSubstr("quaternion"));
}

sensor_msgs::Image MakeImage(const std::string& encoding, std::vector<uint8_t> pixel) {
  sensor_msgs::Image image;
  image.header.stamp = ToRosTime(kTime);
  image.width = 3;
  image.height = 2;
  image.encoding = encoding;
  image.step = static_cast<uint32_t>(3 * pixel.size() + 5);  // padded rows
  image.data.resize(image.step * image.height, 0xEE);
  for (size_t row = 0; row < 2; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      std::copy(pixel.begin(), pixel.end(),
                image.data.begin() + static_cast<long>(row * image.step + column * pixel.size()));
    }
  }
  return image;
}

uint8_t GreyOf(const sensor_msgs::Image& image) {
  const auto result = ParseImage(Serialize(image));
  EXPECT_TRUE(result.value) << result.problem;
  if (!result.value) return 0;
  EXPECT_EQ(result.value->image.data.size(), 6U);
  EXPECT_EQ(result.value->image.data.front(), result.value->image.data.back());
  return result.value->image.data.front();
}

TEST(Ros1Messages, ImagesOfEveryEncodingBecomeGrey) {
  EXPECT_EQ(GreyOf(MakeImage("mono8", {77})), 77);
  EXPECT_EQ(GreyOf(MakeImage("mono16", {0x34, 0x12})), 0x12);
  sensor_msgs::Image big_endian = MakeImage("mono16", {0x34, 0x12});
  big_endian.is_bigendian = 1;
  EXPECT_EQ(GreyOf(big_endian), 0x34);
  EXPECT_EQ(GreyOf(MakeImage("rgb8", {255, 0, 0})), 76);
  EXPECT_EQ(GreyOf(MakeImage("bgr8", {255, 0, 0})), 29);
  EXPECT_EQ(GreyOf(MakeImage("bgra8", {10, 10, 10, 99})), 10);
  EXPECT_EQ(ImageEncoding(Serialize(MakeImage("mono8", {1})), false), "mono8");
}

TEST(Ros1Messages, ImagesThatLieAreRefused) {
  EXPECT_THAT(ParseImage(Serialize(MakeImage("yuv422", {1, 2}))).problem, HasSubstr("'yuv422'"));
  sensor_msgs::Image image = MakeImage("mono8", {1});
  image.height = 200;
  EXPECT_THAT(ParseImage(Serialize(image)).problem, HasSubstr("do not agree"));
  image = MakeImage("rgb8", {1, 2, 3});
  image.step = 4;
  EXPECT_THAT(ParseImage(Serialize(image)).problem, HasSubstr("do not agree"));
  image = MakeImage("mono8", {1});
  image.width = 0xFFFFFFFF;
  EXPECT_THAT(ParseImage(Serialize(image)).problem, HasSubstr("do not agree"));
}

TEST(Ros1Messages, CompressedImageRoundTrip) {
  CameraFrame frame{kTime, "mono", {4, 2, {1, 2, 3, 4, 5, 6, 7, 8}}};
  const auto bytes = Serialize(ToRos(frame));
  const auto result = ParseCompressedImage(bytes);
  ASSERT_TRUE(result.value) << result.problem;
  EXPECT_EQ(result.value->time, kTime);
  EXPECT_EQ(result.value->image.data, frame.image.data);
  EXPECT_FALSE(ParseCompressedImage({bytes.data(), bytes.size() - 1}).value);
}

TEST(Ros1Messages, CameraInfoRoundTrip) {
  CameraIntrinsics intrinsics{CameraModelType::kPinhole,  640, 480, {381.0, 382.0}, {319.5, 239.5},
                              {-0.1, 0.02, 0.001, -0.002}};
  auto result = ParseCameraInfo(Serialize(ToRos(intrinsics)));
  ASSERT_TRUE(result.value) << result.problem;
  EXPECT_EQ(result.value->focal, intrinsics.focal);
  EXPECT_EQ(result.value->principal_point, intrinsics.principal_point);
  EXPECT_EQ(result.value->distortion, intrinsics.distortion);
  EXPECT_EQ(result.value->width, 640);
  intrinsics.model = CameraModelType::kKannalaBrandt;
  result = ParseCameraInfo(Serialize(ToRos(intrinsics)));
  ASSERT_TRUE(result.value) << result.problem;
  EXPECT_EQ(result.value->model, CameraModelType::kKannalaBrandt);
}

}  // namespace
}  // namespace regolith
