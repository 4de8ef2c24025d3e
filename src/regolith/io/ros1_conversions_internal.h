// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Not one of the exported headers: it names ROS types, and is for .cc files only.
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud2.h>

#include "regolith/geometry/trajectory.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"

namespace regolith {

/// Throws CheckError for times that ROS cannot hold (before 0 or past 2106).
ros::Time ToRosTime(TimeNs time);

sensor_msgs::Imu ToRos(const ImuSample& sample);
/// Fields x y z intensity (float32), ring (uint16), time (float32), as the Velodyne driver packs
/// them; without `time` where the scan has none.
sensor_msgs::PointCloud2 ToRos(const LidarScan& scan);
/// A PNG.
sensor_msgs::CompressedImage ToRos(const CameraFrame& frame);
nav_msgs::Odometry ToRos(const WheelOdometry& odometry);
/// Of frame `imu` in `world`.
geometry_msgs::PoseStamped ToRos(const StampedPose& pose);
sensor_msgs::CameraInfo ToRos(const CameraIntrinsics& intrinsics);

}  // namespace regolith
