// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/ros1_messages.h"

#include <cmath>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/io/image_file.h"
#include "regolith/io/wire_reader.h"

namespace regolith {
namespace {

constexpr double kLargestAngularVelocity = 100.0;  // rad/s
constexpr double kLargestSpecificForce = 2000.0;   // m/s²
constexpr double kQuaternionTolerance = 0.05;

Eigen::Vector3d ReadVector(WireReader& reader) {
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) vector[i] = reader.Read<double>();
  return vector;
}

/// geometry_msgs/Pose, its quaternion as it stands (x y z w on the wire).
SE3 ReadPose(WireReader& reader) {
  SE3 pose;
  pose.translation = ReadVector(reader);
  for (int i = 0; i < 4; ++i) pose.rotation.coeffs()[i] = reader.Read<double>();
  return pose;
}

/// What keeps a pose from being one; empty where nothing does. Normalises it.
std::string CheckPose(SE3* pose) {
  if (!pose->translation.allFinite() || !pose->rotation.coeffs().allFinite()) {
    return "values that are not finite";
  }
  if (std::abs(pose->rotation.norm() - 1.0) > kQuaternionTolerance) {
    return "orientation is no unit quaternion";
  }
  pose->rotation.normalize();
  return {};
}

constexpr const char* kTooShort = "shorter than its type";

struct PixelFormat {
  size_t bytes = 0;  ///< a pixel
  size_t red = 0;    ///< channel; equal to the others for grey
  size_t green = 0;
  size_t blue = 0;
  bool wide = false;  ///< 16 bits
};

std::optional<PixelFormat> FindFormat(const std::string& encoding) {
  if (encoding == "mono8" || encoding == "8UC1") return PixelFormat{1, 0, 0, 0, false};
  if (encoding == "mono16" || encoding == "16UC1") return PixelFormat{2, 0, 0, 0, true};
  if (encoding == "rgb8") return PixelFormat{3, 0, 1, 2, false};
  if (encoding == "bgr8" || encoding == "8UC3") return PixelFormat{3, 2, 1, 0, false};
  if (encoding == "rgba8") return PixelFormat{4, 0, 1, 2, false};
  if (encoding == "bgra8" || encoding == "8UC4") return PixelFormat{4, 2, 1, 0, false};
  return std::nullopt;
}

/// Rec. 601 luma in 14-bit fixed point.
uint8_t Luma(uint8_t red, uint8_t green, uint8_t blue) {
  return static_cast<uint8_t>((red * 4899 + green * 9617 + blue * 1868 + 8192) >> 14);
}

void ConvertRow(const uint8_t* row, const PixelFormat& format, bool big_endian, int width,
                std::vector<uint8_t>* grey) {
  const size_t columns = static_cast<size_t>(width);
  if (format.bytes == 1) {
    grey->insert(grey->end(), row, row + columns);
    return;
  }
  for (size_t i = 0; i < columns; ++i) {
    const uint8_t* const pixel = row + i * format.bytes;
    grey->push_back(format.wide ? pixel[big_endian ? 0 : 1]
                                : Luma(pixel[format.red], pixel[format.green], pixel[format.blue]));
  }
}

}  // namespace

std::optional<TimeNs> HeaderStamp(MessageBytes message) {
  WireReader reader(message);
  const TimeNs stamp = reader.ReadHeader();
  if (!reader.ok()) return std::nullopt;
  return stamp;
}

MessageResult<ImuSample> ParseImu(MessageBytes message) {
  constexpr size_t kCovariance = 9 * sizeof(double);
  WireReader reader(message);
  ImuSample sample;
  sample.time = reader.ReadHeader();
  reader.Skip(4 * sizeof(double) + kCovariance);
  sample.angular_velocity = ReadVector(reader);
  reader.Skip(kCovariance);
  sample.specific_force = ReadVector(reader);
  if (!reader.ok()) return {std::nullopt, kTooShort};
  if (!sample.angular_velocity.allFinite() || !sample.specific_force.allFinite()) {
    return {std::nullopt, "values that are not finite"};
  }
  if (sample.angular_velocity.norm() > kLargestAngularVelocity ||
      sample.specific_force.norm() > kLargestSpecificForce) {
    return {std::nullopt, "values that no IMU measures"};
  }
  return {sample, {}};
}

MessageResult<WheelOdometry> ParseOdometry(MessageBytes message) {
  WireReader reader(message);
  WheelOdometry odometry;
  odometry.time = reader.ReadHeader();
  reader.ReadArray();
  odometry.T_odom_base = ReadPose(reader);
  reader.Skip(36 * sizeof(double));
  odometry.linear_velocity_base = ReadVector(reader);
  odometry.angular_velocity_base = ReadVector(reader);
  if (!reader.ok()) return {std::nullopt, kTooShort};
  const std::string problem = CheckPose(&odometry.T_odom_base);
  if (!problem.empty()) return {std::nullopt, problem};
  if (!odometry.linear_velocity_base.allFinite() || !odometry.angular_velocity_base.allFinite()) {
    return {std::nullopt, "values that are not finite"};
  }
  return {odometry, {}};
}

MessageResult<StampedPose> ParsePose(MessageBytes message) {
  WireReader reader(message);
  StampedPose pose;
  pose.time = reader.ReadHeader();
  pose.T_world_body = ReadPose(reader);
  if (!reader.ok()) return {std::nullopt, kTooShort};
  const std::string problem = CheckPose(&pose.T_world_body);
  if (!problem.empty()) return {std::nullopt, problem};
  return {pose, {}};
}

MessageResult<CameraFrame> ParseImage(MessageBytes message) {
  WireReader reader(message);
  CameraFrame frame;
  frame.time = reader.ReadHeader();
  const uint32_t height = reader.Read<uint32_t>();
  const uint32_t width = reader.Read<uint32_t>();
  const std::string encoding = reader.ReadString();
  const bool big_endian = reader.Read<uint8_t>() != 0;
  const size_t step = reader.Read<uint32_t>();
  const Span<const uint8_t> data = reader.ReadArray();
  if (!reader.ok()) return {std::nullopt, kTooShort};
  const auto format = FindFormat(encoding);
  if (!format) {
    return {std::nullopt, "encoding '" + encoding + "' (expected mono8, mono16, bgr8 or rgb8)"};
  }
  if (width == 0 || height == 0 || width > 65535 || height > 65535 ||
      step < width * format->bytes || data.size() < step * height) {
    return {std::nullopt, "size, step and data that do not agree"};
  }
  frame.image.width = static_cast<int>(width);
  frame.image.height = static_cast<int>(height);
  frame.image.data.reserve(static_cast<size_t>(width) * height);
  for (size_t row = 0; row < height; ++row) {
    ConvertRow(data.data() + row * step, *format, big_endian, frame.image.width, &frame.image.data);
  }
  return {std::move(frame), {}};
}

MessageResult<CameraFrame> ParseCompressedImage(MessageBytes message) {
  WireReader reader(message);
  CameraFrame frame;
  frame.time = reader.ReadHeader();
  reader.ReadArray();
  const Span<const uint8_t> data = reader.ReadArray();
  if (!reader.ok()) return {std::nullopt, kTooShort};
  auto image = DecodeImage(data);
  if (!image) return {std::nullopt, "data that is neither PNG nor JPEG, or damaged"};
  frame.image = std::move(*image);
  return {std::move(frame), {}};
}

MessageResult<CameraIntrinsics> ParseCameraInfo(MessageBytes message) {
  WireReader reader(message);
  CameraIntrinsics intrinsics;
  reader.ReadHeader();
  intrinsics.height = static_cast<int>(reader.Read<uint32_t>());
  intrinsics.width = static_cast<int>(reader.Read<uint32_t>());
  const std::string model = reader.ReadString();
  const uint32_t count = reader.Read<uint32_t>();
  if (!reader.ok() || count > 14) return {std::nullopt, "distortion of unknown length"};
  for (uint32_t i = 0; i < count; ++i) {
    const double coefficient = reader.Read<double>();
    if (i < 4) intrinsics.distortion[i] = coefficient;
    if (i >= 4 && coefficient != 0.0) return {std::nullopt, "more than four coefficients"};
  }
  intrinsics.focal.x() = reader.Read<double>();
  reader.Skip(sizeof(double));
  intrinsics.principal_point.x() = reader.Read<double>();
  reader.Skip(sizeof(double));
  intrinsics.focal.y() = reader.Read<double>();
  intrinsics.principal_point.y() = reader.Read<double>();
  if (!reader.ok()) return {std::nullopt, kTooShort};
  if (model == "equidistant") {
    intrinsics.model = CameraModelType::kKannalaBrandt;
  } else if (model != "plumb_bob" && !model.empty()) {
    return {std::nullopt, "distortion model '" + model + "'"};
  }
  return {intrinsics, {}};
}

std::string ImageEncoding(MessageBytes message, bool compressed) {
  WireReader reader(message);
  reader.ReadHeader();
  if (!compressed) reader.Skip(2 * sizeof(uint32_t));
  return reader.ReadString();
}

}  // namespace regolith
