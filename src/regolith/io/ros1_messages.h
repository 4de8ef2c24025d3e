// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "regolith/core/span.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sensor/image.h"
#include "regolith/sensor/imu_sample.h"
#include "regolith/sensor/wheel_odometry.h"

namespace regolith {

/// A serialized ROS 1 message.
using MessageBytes = Span<const uint8_t>;

/// What a message says, or why it cannot be used.
template <typename T>
struct MessageResult {
  std::optional<T> value;
  std::string problem;
};

/// The stamp of any message that begins with a std_msgs/Header; nothing where it is too short.
std::optional<TimeNs> HeaderStamp(MessageBytes message);

/// sensor_msgs/Imu. Refused: values that are not finite or that no IMU measures (beyond 100 rad/s
/// or 2000 m/s²).
MessageResult<ImuSample> ParseImu(MessageBytes message);

/// nav_msgs/Odometry. Refused: values that are not finite, an orientation that is no rotation.
MessageResult<WheelOdometry> ParseOdometry(MessageBytes message);

/// geometry_msgs/PoseStamped.
MessageResult<StampedPose> ParsePose(MessageBytes message);

/// sensor_msgs/Image as 8-bit grey: mono8, mono16 (upper 8 bits), bgr8, rgb8, bgra8, rgba8, 8UC1,
/// 16UC1, 8UC3. The frame's `camera` is left empty.
MessageResult<CameraFrame> ParseImage(MessageBytes message);

/// sensor_msgs/CompressedImage (PNG or JPEG) as 8-bit grey.
MessageResult<CameraFrame> ParseCompressedImage(MessageBytes message);

/// sensor_msgs/CameraInfo: plumb_bob (its fifth coefficient must be 0), equidistant.
MessageResult<CameraIntrinsics> ParseCameraInfo(MessageBytes message);

/// The encoding (sensor_msgs/Image) or format (CompressedImage) of an image message.
std::string ImageEncoding(MessageBytes message, bool compressed);

}  // namespace regolith
