// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/place_observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

RigCalibration Rig() {
  RigCalibration rig;
  rig.lidar.emplace();
  rig.lidar->T_imu_lidar.translation = {0.0, 0.0, 0.3};
  CameraCalibration& camera = rig.cameras["mono"];
  camera.intrinsics.width = 320;
  camera.intrinsics.height = 240;
  camera.intrinsics.focal = {190.0, 190.0};
  camera.intrinsics.principal_point = {159.5, 119.5};
  Eigen::Matrix3d R_level_camera;  // x right, y down, z forward
  R_level_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  camera.T_imu_camera = {ExpSo3({0.0, 0.5, 0.0}) * Eigen::Quaterniond(R_level_camera),
                         {0.3, 0.1, 0.2}};
  return rig;
}

PipelineOptions Options() {
  PipelineOptions options;
  options.tracked_camera = "mono";
  options.features.frontend = "st_lk";  // whatever it is, places are found by ORB
  return options;
}

/// Level ground with tiles of differing grey, 1 m below the body.
uint8_t GreyAt(double x, double y) {
  constexpr double kTile = 0.08;  // m
  const auto column = static_cast<uint64_t>(std::floor(x / kTile) + 10000);
  const auto row = static_cast<uint64_t>(std::floor(y / kTile) + 10000);
  return static_cast<uint8_t>(60 + Scramble(column * 100003 + row) % 140);
}

SE3 BodyAt(double x, double yaw) { return {ExpSo3({0.0, 0.0, yaw}), {x, 0.0, 1.0}}; }

std::shared_ptr<const CameraFrame> ImageFrom(const SE3& T_world_body) {
  const CameraCalibration calibration = Rig().cameras.at("mono");
  const auto camera = CameraModel::Create(calibration.intrinsics);
  const SE3 T_world_camera = T_world_body * calibration.T_imu_camera;
  CameraFrame frame{0, "mono", {camera->intrinsics().width, camera->intrinsics().height, {}}};
  for (int row = 0; row < frame.image.height; ++row) {
    for (int column = 0; column < frame.image.width; ++column) {
      const Eigen::Vector3d ray =
          T_world_camera.rotation * *camera->Unproject(Eigen::Vector2d(column, row));
      const double range = ray.z() < -0.05 ? -T_world_camera.translation.z() / ray.z() : 0.0;
      const Eigen::Vector3d point = T_world_camera.translation + range * ray;
      frame.image.data.push_back(range > 0.0 ? GreyAt(point.x(), point.y()) : 20);
    }
  }
  return std::make_shared<const CameraFrame>(frame);
}

/// Scans of the metres before a place: rings on the ground.
std::vector<std::shared_ptr<const ScanEstimate>> ScansUntil(double x) {
  std::vector<std::shared_ptr<const ScanEstimate>> scans;
  for (int i = 0; i <= 25; ++i) {
    auto scan = std::make_shared<ScanEstimate>();
    scan->stamp = FromSeconds(0.4 * i);
    scan->T_world_body = BodyAt(x - 5.0 + 0.2 * i, 0.0);
    for (const double radius : {4.5, 5.2, 6.2, 7.6}) {
      for (double azimuth = -1.2; azimuth < 1.2; azimuth += 0.004) {
        const Eigen::Vector3d point =
            scan->T_world_body.translation +
            Eigen::Vector3d(radius * std::cos(azimuth), radius * std::sin(azimuth), -1.0);
        MapPoint map_point;
        map_point.position = point.cast<float>();
        scan->points.push_back(map_point);
      }
    }
    scans.push_back(scan);
  }
  return scans;
}

TEST(PlaceObserver, FeaturesHaveTheDistanceOfTheGroundThatTheLidarSaw) {
  PlaceObserver observer(Options(), Rig(), std::nullopt);
  // The image was taken a little before the keyframe.
  const SE3 T_odom_image = BodyAt(0.0, 0.0);
  const PlaceView view = observer.Observe({ImageFrom(T_odom_image), T_odom_image, ScansUntil(0.0)},
                                          BodyAt(0.04, 0.02));
  ASSERT_GT(view.descriptors.size(), 150U);
  EXPECT_EQ(view.descriptors.type, DescriptorType::kBinary);
  size_t known = 0;
  const SE3 T_odom_camera = BodyAt(0.04, 0.02) * view.T_body_camera;
  for (size_t i = 0; i < view.ranges.size(); ++i) {
    if (view.ranges[i] <= 0.0) continue;
    ++known;
    EXPECT_NEAR((T_odom_camera * (view.ranges[i] * view.bearings[i])).z(), 0.0, 0.02);
  }
  EXPECT_GT(known, view.descriptors.size() / 2);
}

TEST(PlaceObserver, APlaceIsFoundAgainFromItsViews) {
  PlaceObserver observer(Options(), Rig(), std::nullopt);
  const SE3 first = BodyAt(0.0, 0.0);
  const SE3 second(ExpSo3({0.0, 0.0, 0.1}), {0.25, 0.1, 1.0});
  PlaceView old_view = observer.Observe({ImageFrom(first), first, ScansUntil(0.0)}, first);
  PlaceView new_view = observer.Observe({ImageFrom(second), second, {}}, second);
  for (PlaceView* view : {&old_view, &new_view}) view->global = Eigen::VectorXf::Ones(1);
  VisualPlaces places{VisualPlacesOptions()};
  places.Add(0, old_view);
  places.Add(1, new_view);
  const std::vector<LoopCandidate> candidates = places.Propose(1);
  ASSERT_EQ(candidates.size(), 1U);
  const SE3 error = (first.Inverse() * second).Inverse() * candidates[0].guess.T_target_query;
  EXPECT_LT(error.translation.norm(), 0.06);
  EXPECT_LT(LogSo3(error.rotation).norm(), 0.025);
}

TEST(PlaceObserver, WhatTheMaskCoversIsNotSeen) {
  const Image mask{320, 240, std::vector<uint8_t>(320 * 240, 0)};
  PlaceObserver observer(Options(), Rig(), mask);
  const SE3 pose = BodyAt(0.0, 0.0);
  EXPECT_EQ(observer.Observe({ImageFrom(pose), pose, {}}, pose).descriptors.size(), 0U);
}

}  // namespace
}  // namespace regolith
