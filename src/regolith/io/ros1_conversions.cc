// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/ros1_conversions_internal.h"

#include <cstring>

#include "regolith/core/check.h"
#include "regolith/io/image_file.h"

namespace regolith {
namespace {

geometry_msgs::Vector3 ToRos(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

geometry_msgs::Pose ToRos(const SE3& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.translation.x();
  message.position.y = pose.translation.y();
  message.position.z = pose.translation.z();
  message.orientation.x = pose.rotation.x();
  message.orientation.y = pose.rotation.y();
  message.orientation.z = pose.rotation.z();
  message.orientation.w = pose.rotation.w();
  return message;
}

/// Adds a field behind the last one.
void AddField(const std::string& name, uint8_t type, uint32_t size,
              sensor_msgs::PointCloud2* cloud) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = cloud->point_step;
  field.datatype = type;
  field.count = 1;
  cloud->fields.push_back(field);
  cloud->point_step += size;
}

}  // namespace

ros::Time ToRosTime(TimeNs time) {
  constexpr TimeNs kSecond = 1000000000;
  REGOLITH_CHECK(time >= 0 && time / kSecond <= UINT32_MAX, "time ", time, " ns");
  return {static_cast<uint32_t>(time / kSecond), static_cast<uint32_t>(time % kSecond)};
}

sensor_msgs::Imu ToRos(const ImuSample& sample) {
  sensor_msgs::Imu message;
  message.header.stamp = ToRosTime(sample.time);
  message.header.frame_id = "imu";
  message.orientation.w = 1.0;
  message.orientation_covariance[0] = -1.0;  // "no orientation", as the message defines it
  message.angular_velocity = ToRos(sample.angular_velocity);
  message.linear_acceleration = ToRos(sample.specific_force);
  return message;
}

sensor_msgs::PointCloud2 ToRos(const LidarScan& scan) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = ToRosTime(scan.stamp);
  cloud.header.frame_id = "lidar";
  for (const char* const name : {"x", "y", "z", "intensity"}) {
    AddField(name, sensor_msgs::PointField::FLOAT32, 4, &cloud);
  }
  AddField("ring", sensor_msgs::PointField::UINT16, 2, &cloud);
  if (scan.has_point_times) AddField("time", sensor_msgs::PointField::FLOAT32, 4, &cloud);
  cloud.height = 1;
  cloud.width = static_cast<uint32_t>(scan.points.size());
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.is_dense = 1;
  cloud.data.resize(cloud.row_step);
  uint8_t* bytes = cloud.data.data();
  for (const LidarPoint& point : scan.points) {
    std::memcpy(bytes, point.position.data(), 12);
    std::memcpy(bytes + 12, &point.intensity, 4);
    std::memcpy(bytes + 16, &point.ring, 2);
    if (scan.has_point_times) std::memcpy(bytes + 18, &point.time, 4);
    bytes += cloud.point_step;
  }
  return cloud;
}

sensor_msgs::CompressedImage ToRos(const CameraFrame& frame) {
  sensor_msgs::CompressedImage message;
  message.header.stamp = ToRosTime(frame.time);
  message.header.frame_id = frame.camera;
  message.format = "mono8; png compressed mono8";
  message.data = EncodePng(frame.image);
  return message;
}

nav_msgs::Odometry ToRos(const WheelOdometry& odometry) {
  nav_msgs::Odometry message;
  message.header.stamp = ToRosTime(odometry.time);
  message.header.frame_id = "odom";
  message.child_frame_id = "base";
  message.pose.pose = ToRos(odometry.T_odom_base);
  message.twist.twist.linear = ToRos(odometry.linear_velocity_base);
  message.twist.twist.angular = ToRos(odometry.angular_velocity_base);
  return message;
}

geometry_msgs::PoseStamped ToRos(const StampedPose& pose) {
  geometry_msgs::PoseStamped message;
  message.header.stamp = ToRosTime(pose.time);
  message.header.frame_id = "world";
  message.pose = ToRos(pose.T_world_body);
  return message;
}

sensor_msgs::CameraInfo ToRos(const CameraIntrinsics& intrinsics) {
  sensor_msgs::CameraInfo message;
  message.height = static_cast<uint32_t>(intrinsics.height);
  message.width = static_cast<uint32_t>(intrinsics.width);
  const bool pinhole = intrinsics.model == CameraModelType::kPinhole;
  message.distortion_model = pinhole ? "plumb_bob" : "equidistant";
  message.D.assign(intrinsics.distortion.begin(), intrinsics.distortion.end());
  if (pinhole) message.D.push_back(0.0);
  message.K = {intrinsics.focal.x(),
               0.0,
               intrinsics.principal_point.x(),
               0.0,
               intrinsics.focal.y(),
               intrinsics.principal_point.y(),
               0.0,
               0.0,
               1.0};
  message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message.P = {message.K[0], 0.0, message.K[2], 0.0, 0.0, message.K[4],
               message.K[5], 0.0, 0.0,          0.0, 1.0, 0.0};
  return message;
}

}  // namespace regolith
