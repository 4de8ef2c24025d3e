// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/slam_system.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "regolith/core/error.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

LidarScan Room(TimeNs stamp) {
  LidarScan scan;
  scan.stamp = stamp;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 60; ++j) {
      const float a = -6.0F + 0.2F * static_cast<float>(i);
      const float b = -6.0F + 0.2F * static_cast<float>(j);
      for (const Eigen::Vector3f& position :
           {Eigen::Vector3f(a, b, -1.0F), Eigen::Vector3f(6.0F, a, b),
            Eigen::Vector3f(a, 6.0F, b)}) {
        LidarPoint point;
        point.position = position;
        scan.points.push_back(point);
      }
    }
  }
  return scan;
}

RigCalibration RigWithCamera() {
  RigCalibration rig;
  rig.lidar.emplace();
  CameraCalibration& camera = rig.cameras["mono"];
  camera.intrinsics.width = 160;
  camera.intrinsics.height = 120;
  camera.intrinsics.focal = {100.0, 100.0};
  camera.intrinsics.principal_point = {79.5, 59.5};
  return rig;
}

TEST(SlamSystem, EveryScanGetsAPoseAndTheMapGrows) {
  RigCalibration rig;
  rig.lidar.emplace();
  ThreadPool threads(1);
  SlamSystem system({}, rig, &threads);
  EXPECT_FALSE(system.needs().imu);
  for (int i = 0; i < 5; ++i) {
    const auto reports = system.Process(Room(FromSeconds(0.1 * i)));
    ASSERT_EQ(reports.size(), 1U);
    EXPECT_LT(reports[0].T_world_body.translation.norm(), 0.01);
    EXPECT_FALSE(reports[0].stages.empty());
  }
  EXPECT_TRUE(system.Finish().empty());
  EXPECT_EQ(system.trajectory().size(), 5U);
  EXPECT_EQ(system.scans_seen(), 5U);
  EXPECT_GT(system.MapPoints().size(), 5000U);
  ASSERT_NE(system.backend(), nullptr);
  EXPECT_EQ(system.keyframe_counts().keyframes, 1U);
}

TEST(SlamSystem, TheBackEndCanBeLeftOut) {
  RigCalibration rig;
  rig.lidar.emplace();
  ThreadPool threads(1);
  PipelineOptions options;
  options.backend.enabled = false;
  SlamSystem system(options, rig, &threads);
  system.Process(Room(0));
  EXPECT_EQ(system.backend(), nullptr);
  EXPECT_EQ(system.keyframe_counts().keyframes, 0U);
  EXPECT_EQ(system.trajectory().size(), 1U);
  options.backend.enabled = true;
  options.odometry = OdometryKind::kLegoLoam;
  EXPECT_EQ(SlamSystem(options, rig, &threads).backend(), nullptr);
}

TEST(SlamSystem, WithoutTheLidarTheOtherSensorsHaveToBeThere) {
  PipelineOptions options;
  options.name = "wheels";
  options.lio.lidar = false;
  options.lio.wheels = true;
  RigCalibration rig;
  rig.lidar.emplace();
  ThreadPool threads(1);
  EXPECT_THROW(SlamSystem(options, rig, &threads), InputError);
  rig.imu.emplace();
  EXPECT_THROW(SlamSystem(options, rig, &threads), InputError);
  rig.wheels.emplace();
  EXPECT_TRUE(SlamSystem(options, rig, &threads).needs().wheels);
}

TEST(SlamSystem, SaysWhatTheRigLacksOfWhatTheOptionsAskFor) {
  PipelineOptions options;
  options.visual = true;
  options.vio.wheels = true;
  options.tracked_camera = "mono";
  RigCalibration rig;
  rig.lidar.emplace();
  ThreadPool threads(1);
  const std::vector<std::string> notices = SlamSystem(options, rig, &threads).Notices();
  ASSERT_EQ(notices.size(), 2U);
  EXPECT_NE(notices[0].find("no wheels"), std::string::npos);
  EXPECT_NE(notices[1].find("no imu"), std::string::npos);
}

TEST(SlamSystem, WheelsOfTheCamerasPartAreRead) {
  PipelineOptions options;
  options.visual = true;
  options.vio.wheels = true;
  options.tracked_camera = "mono";
  options.features.frontend = "st_lk";
  RigCalibration rig = RigWithCamera();
  rig.imu.emplace();
  rig.wheels.emplace();
  ThreadPool threads(1);
  EXPECT_TRUE(SlamSystem(options, rig, &threads).needs().wheels);
  options.vio.wheels = false;
  EXPECT_FALSE(SlamSystem(options, rig, &threads).needs().wheels);
}

TEST(SlamSystem, LegoLoamReadsTheLidarAlone) {
  PipelineOptions options;
  options.odometry = OdometryKind::kLegoLoam;
  options.lio.wheels = true;
  RigCalibration rig;
  rig.lidar.emplace();
  rig.imu.emplace();
  rig.wheels.emplace();
  ThreadPool threads(1);
  const SlamSystem system(options, rig, &threads);
  EXPECT_FALSE(system.needs().imu);
  EXPECT_FALSE(system.needs().wheels);
}

TEST(SlamSystem, TracksTheImagesOfTheCameraNamed) {
  PipelineOptions options;
  options.features.frontend = "st_lk";
  ThreadPool threads(1);
  EXPECT_TRUE(SlamSystem(options, RigWithCamera(), &threads).needs().cameras.empty());
  options.tracked_camera = "left";
  EXPECT_TRUE(SlamSystem(options, RigWithCamera(), &threads).needs().cameras.empty());
  options.tracked_camera = "mono";
  SlamSystem system(options, RigWithCamera(), &threads);
  EXPECT_EQ(system.needs().cameras, std::vector<std::string>{"mono"});

  CameraFrame frame;
  frame.camera = "mono";
  frame.image = {160, 120, std::vector<uint8_t>(160 * 120)};
  for (size_t i = 0; i < frame.image.data.size(); ++i) {
    frame.image.data[i] = static_cast<uint8_t>(200.0 * HashUniform(5, i / 160 / 9, i % 160 / 9));
  }
  for (int i = 0; i < 3; ++i) {
    frame.time = FromSeconds(0.1 * i);
    const auto reports = system.Process(frame);
    ASSERT_EQ(reports.size(), 1U);
    EXPECT_EQ(reports[0].source, FrameSource::kImage);
    EXPECT_EQ(reports[0].leader, "camera");
    EXPECT_EQ(reports[0].stamp, frame.time);
    EXPECT_GT(i == 0 ? reports[0].features.started : reports[0].features.tracked, 30);
    EXPECT_FALSE(reports[0].stages.empty());
  }
  frame.camera = "left";
  EXPECT_TRUE(system.Process(frame).empty());
  EXPECT_EQ(system.images_seen(), 3U);
  EXPECT_TRUE(system.trajectory().poses().empty());
}

TEST(SlamSystem, ARigWithoutALidarIsServedByTheOthersOrRefused) {
  ThreadPool threads(1);
  PipelineOptions options;
  EXPECT_THROW(SlamSystem(options, RigCalibration(), &threads), InputError);
  options.visual = true;
  options.lio.wheels = true;
  options.tracked_camera = "mono";
  options.features.frontend = "st_lk";
  RigCalibration rig = RigWithCamera();
  rig.lidar.reset();
  EXPECT_THROW(SlamSystem(options, rig, &threads), InputError);
  rig.imu.emplace();
  const SlamSystem sees(options, rig, &threads);
  EXPECT_EQ(sees.needs().cameras.size(), 1U);
  EXPECT_FALSE(sees.needs().may_lack_cameras);  // they are all that is left
  EXPECT_NE(sees.Notices()[0].find("no lidar: visual"), std::string::npos);
  rig.cameras.clear();
  EXPECT_THROW(SlamSystem(options, rig, &threads), InputError);
  rig.wheels.emplace();
  const SlamSystem rolls(options, rig, &threads);
  EXPECT_TRUE(rolls.needs().wheels);
  EXPECT_FALSE(rolls.needs().lidar);
  EXPECT_FALSE(rolls.needs().may_lack_wheels);
  EXPECT_NE(rolls.Notices()[0].find("no lidar: IMU and wheels"), std::string::npos);
}

/// A still rover in a room: 20 scans, with IMU and wheels; none of the lidar from `from` to `to`.
std::vector<FrameReport> StandInRoom(SlamSystem* system, double from, double to) {
  std::vector<FrameReport> reports;
  const auto take = [&](std::vector<FrameReport> more) {
    for (FrameReport& report : more) reports.push_back(std::move(report));
  };
  for (int i = 0; i < 1200; ++i) {
    const double time = 0.005 * i;
    ImuSample sample;
    sample.time = FromSeconds(time);
    sample.specific_force = {0.0, 0.0, 9.81};
    take(system->Process(sample));
    WheelOdometry wheels;
    wheels.time = sample.time;
    if (i % 4 == 0) take(system->Process(wheels));
    if (i % 20 == 0 && (time < from || time >= to)) take(system->Process(Room(sample.time)));
  }
  take(system->Finish());
  return reports;
}

TEST(SlamSystem, ReportsDoNotDependOnThreads) {
  RigCalibration rig;
  rig.lidar.emplace();
  rig.imu.emplace();
  rig.wheels.emplace();
  rig.gravity = 9.81;
  PipelineOptions options;
  options.lio.wheels = true;
  std::vector<std::vector<FrameReport>> runs;
  for (const int count : {1, 3}) {
    ThreadPool threads(count);
    SlamSystem system(options, rig, &threads);
    runs.push_back(StandInRoom(&system, 7.0, 7.0));
    EXPECT_EQ(system.trajectory().size(), 60U);
    ASSERT_TRUE(system.live());
    EXPECT_LT(system.live()->T_world_imu.translation.norm(), 0.05);
    EXPECT_EQ(system.live()->time, FromSeconds(0.005 * 1199));
  }
  ASSERT_EQ(runs[0].size(), 60U);
  ASSERT_EQ(runs[1].size(), 60U);
  for (size_t i = 0; i < runs[0].size(); ++i) {
    EXPECT_EQ(runs[0][i].stamp, runs[1][i].stamp);
    EXPECT_EQ(runs[0][i].states, runs[1][i].states);
    EXPECT_EQ(runs[0][i].T_world_body.translation, runs[1][i].T_world_body.translation);
    EXPECT_EQ(runs[0][i].covariance, runs[1][i].covariance);
  }
}

TEST(SlamSystem, TheOthersCarryOnWhileTheLidarIsSilent) {
  RigCalibration rig;
  rig.lidar.emplace();
  rig.imu.emplace();
  rig.wheels.emplace();
  rig.gravity = 9.81;
  PipelineOptions options;
  options.lio.wheels = true;
  ThreadPool threads(2);
  SlamSystem system(options, rig, &threads);
  const std::vector<FrameReport> reports = StandInRoom(&system, 2.0, 4.0);
  size_t without = 0;
  for (const FrameReport& report : reports) {
    if (report.has_scan) continue;
    ++without;
    EXPECT_EQ(report.leader, "wheels+imu");
    EXPECT_LT(report.T_world_body.translation.norm(), 0.05);
    if (SecondsBetween(FromSeconds(2.6), report.stamp) > 0.0) {
      EXPECT_EQ(report.led_by, Subsystem::kWheels);
      EXPECT_EQ(report.states[0], SubsystemState::kSilent);
    }
  }
  EXPECT_NEAR(static_cast<double>(without), 17.0, 2.0);
  EXPECT_EQ(system.stamps_seen(), system.trajectory().size());
  EXPECT_EQ(reports.back().led_by, Subsystem::kLidar);
  const std::vector<std::string> notices = system.Notices();
  EXPECT_TRUE(std::any_of(notices.begin(), notices.end(), [](const std::string& notice) {
    return notice.rfind("led by: lidar", 0) == 0 && notice.find("wheels") != std::string::npos;
  }));
}

TEST(SlamSystem, WhatGoesWrongInsideReachesTheCaller) {
  for (const int count : {1, 2}) {
    RigCalibration rig;
    rig.lidar.emplace();
    rig.imu.emplace();
    rig.gravity = 1.62;
    ThreadPool threads(count);
    SlamSystem system({}, rig, &threads);
    EXPECT_THROW(
        {
          StandInRoom(&system, 7.0, 7.0);
          system.Finish();
        },
        InputError);
    system.Settle();
    EXPECT_EQ(system.trajectory().size(), 0U);
  }
}

}  // namespace
}  // namespace regolith
