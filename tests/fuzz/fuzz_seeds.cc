// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes one small valid input or more for each fuzz target into FOLDER/TARGET.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "regolith/config/rig_config.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/ply.h"
#include "regolith/io/ros1_test_messages_internal.h"
#include "regolith/io/tum.h"

namespace regolith {
namespace {

std::string Place(const std::string& folder, const std::string& target, const std::string& name) {
  std::filesystem::create_directories(folder + "/" + target);
  return folder + "/" + target + "/" + name;
}

template <typename Message>
void WriteMessage(const std::string& path, const Message& message) {
  const std::vector<uint8_t> bytes = Serialize(message);
  WriteFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

RigCalibration Rig() {
  RigCalibration rig;
  rig.gravity = 1.62;
  rig.imu.emplace();
  rig.lidar.emplace();
  rig.wheels.emplace();
  CameraCalibration camera;
  camera.topic = "/mono/image_raw";
  camera.intrinsics.width = 8;
  camera.intrinsics.height = 6;
  camera.intrinsics.focal = {8.0, 8.0};
  camera.intrinsics.principal_point = {3.5, 2.5};
  rig.cameras["mono"] = camera;
  return rig;
}

LidarScan Scan() {
  LidarScan scan;
  for (int i = 0; i < 8; ++i) {
    LidarPoint point;
    const float angle = 0.7F * static_cast<float>(i);
    point.position = {5.0F * std::cos(angle), 5.0F * std::sin(angle), -1.0F};
    point.time = 0.01F * static_cast<float>(i);
    point.ring = static_cast<uint16_t>(i);
    scan.points.push_back(point);
  }
  return scan;
}

CameraFrame Frame() {
  CameraFrame frame;
  frame.camera = "mono";
  frame.image.width = 8;
  frame.image.height = 6;
  frame.image.data.assign(48, 100);
  return frame;
}

void WriteMessages(const std::string& folder) {
  const std::string target = "ros1_messages";
  WriteMessage(Place(folder, "point_cloud", "cloud"), ToRos(Scan()));
  LidarScan untimed = Scan();
  untimed.has_point_times = false;
  WriteMessage(Place(folder, "point_cloud", "untimed"), ToRos(untimed));
  WriteMessage(Place(folder, target, "imu"), ToRos(ImuSample()));
  WriteMessage(Place(folder, target, "odometry"), ToRos(WheelOdometry()));
  WriteMessage(Place(folder, target, "pose"), ToRos(StampedPose()));
  WriteMessage(Place(folder, target, "camera_info"), ToRos(Rig().cameras.at("mono").intrinsics));
  WriteMessage(Place(folder, target, "compressed"), ToRos(Frame()));
}

void WriteSeeds(const std::string& folder) {
  const std::string rig = WriteRig(Rig());
  WriteFile(Place(folder, "rig_yaml", "rig"), rig);
  const std::vector<StampedPose> poses = {{0, SE3()}, {1000000001, SE3()}};
  WriteTum(Place(folder, "tum", "poses"), poses);
  const std::vector<MapPoint> points(2);
  WritePly(Place(folder, "ply", "points"), points);
  WriteMessages(folder);
}

}  // namespace
}  // namespace regolith

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  regolith::WriteSeeds(argv[1]);
  return 0;
}
