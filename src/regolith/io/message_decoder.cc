// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/message_decoder.h"

#include <algorithm>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/io/point_cloud.h"

namespace regolith {
namespace {

template <typename Event>
std::optional<SensorEvent> Unpack(MessageResult<Event> result, TopicFilter& filter) {
  if (!result.value) {
    filter.CountDropped(result.problem);
    return std::nullopt;
  }
  return SensorEvent(std::move(*result.value));
}

std::optional<SensorEvent> UnpackScan(PointCloudResult result, const LidarCalibration& lidar,
                                      TopicFilter& filter) {
  if (!result.scan) {
    filter.CountDropped(result.problem);
    return std::nullopt;
  }
  filter.CountPoints(result.facts.invalid_points);
  if (result.facts.ring_derived) {
    filter.Note(Concatenate("no field 'ring': derived from elevation, ", lidar.rings,
                            " rings between ", lidar.lowest_elevation_deg, " and ",
                            lidar.highest_elevation_deg, " degrees"));
  }
  if (result.facts.time_derived) {
    filter.Note(Concatenate("no usable field 'time': derived from azimuth, ", lidar.period,
                            " s a turn from the stamp on"));
  }
  if (result.facts.time_missing) {
    filter.Note("no usable field 'time' and points not in firing order: scans are not deskewed");
  }
  if (result.facts.intensity_missing) filter.Note("no field 'intensity': taken as 0");
  result.scan->stamp = AddSeconds(result.scan->stamp, lidar.time_offset);
  return SensorEvent(std::move(*result.scan));
}

MessageDecoder CameraDecoder(const SensorTopic& sensor, const CameraCalibration& camera,
                             const std::string& where) {
  const bool compressed = sensor.type == "sensor_msgs/CompressedImage";
  return [=](MessageBytes bytes, TopicFilter& filter) -> std::optional<SensorEvent> {
    auto result = compressed ? ParseCompressedImage(bytes) : ParseImage(bytes);
    if (result.value) {
      result.value->camera = sensor.sensor;
      result.value->time = AddSeconds(result.value->time, camera.time_offset);
      CheckImageSize(where, *result.value, camera);
    }
    return Unpack(std::move(result), filter);
  };
}

}  // namespace

bool SensorTopic::Fits(const std::string& message_type) const {
  return std::find(types.begin(), types.end(), message_type) != types.end();
}

std::vector<SensorTopic> SensorsOf(const RigCalibration& rig) {
  std::vector<SensorTopic> sensors;
  if (rig.imu) sensors.push_back({"imu", rig.imu->topic, {"sensor_msgs/Imu"}, {}});
  if (rig.lidar) sensors.push_back({"lidar", rig.lidar->topic, {"sensor_msgs/PointCloud2"}, {}});
  for (const auto& [name, camera] : rig.cameras) {
    sensors.push_back(
        {name, camera.topic, {"sensor_msgs/Image", "sensor_msgs/CompressedImage"}, {}});
  }
  if (rig.wheels) sensors.push_back({"wheels", rig.wheels->topic, {"nav_msgs/Odometry"}, {}});
  return sensors;
}

MessageDecoder MakeDecoder(const SensorTopic& sensor, const RigCalibration& rig,
                           const std::string& where) {
  if (sensor.sensor == "imu") {
    return [](MessageBytes bytes, TopicFilter& filter) { return Unpack(ParseImu(bytes), filter); };
  }
  if (sensor.sensor == "wheels") {
    return [](MessageBytes bytes, TopicFilter& filter) {
      return Unpack(ParseOdometry(bytes), filter);
    };
  }
  if (sensor.sensor == "lidar") {
    return [lidar = *rig.lidar](MessageBytes bytes, TopicFilter& filter) {
      return UnpackScan(ParsePointCloud(bytes, lidar), lidar, filter);
    };
  }
  return CameraDecoder(sensor, rig.cameras.at(sensor.sensor), where);
}

}  // namespace regolith
