// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/visual_inertial_odometry.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>

#include "regolith/core/error.h"
#include "regolith/geometry/so3.h"
#include "regolith/vio/test_world_internal.h"

namespace regolith {
namespace {

constexpr double kMoonGravity = 1.62;  // m/s²
constexpr double kRoverWay = 7.2;      // m, to the end of its second straight
constexpr double kDegree = 3.14159265358979323846 / 180.0;

TestSensors OnTheMoon() {
  TestSensors sensors;
  sensors.gravity = kMoonGravity;
  return sensors;
}

TestRun RunRover(const VioOptions& options, const TestSensors& sensors, uint64_t seed) {
  const TestRecording recording = Record(RoverMotion(), GroundLandmarks(seed), sensors, 25.0, seed);
  return {options, TestRig(sensors), recording, RoverMotion()};
}

TEST(VisualInertialOdometry, FollowsARoverOnTheMoon) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const TestRun run = RunRover(VioOptions(), OnTheMoon(), seed);
    EXPECT_LT(run.FinalError(), 0.02 * kRoverWay) << "seed " << seed;
    EXPECT_NEAR(run.Scale(), 1.0, 0.03) << "seed " << seed;
    EXPECT_EQ(run.odometry().resets(), 0U);
    EXPECT_TRUE(run.odometry().Notices().empty()) << run.odometry().Notices()[0];
    EXPECT_TRUE(run.Before(2.9).at_rest);
    EXPECT_FALSE(run.Before(8.0).at_rest);
  }
}

TEST(VisualInertialOdometry, WheelsAreWorthLessThanTheySay) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    TestSensors sensors = OnTheMoon();
    sensors.wheel_scale = 1.01;
    sensors.wheel_slip = 0.05;
    VioOptions options;
    options.wheels = true;
    const TestRun run = RunRover(options, sensors, seed);
    EXPECT_NEAR(run.Scale(), 1.0, 0.03) << "seed " << seed;
    EXPECT_LT(run.FinalError(), 0.02 * kRoverWay) << "seed " << seed;
    // Of the wheels' own metres.
    EXPECT_NEAR(run.Before(24.0).slip, 1.0 - 0.95 / 1.01, 0.03) << "seed " << seed;
  }
}

TEST(VisualInertialOdometry, StartsInMotion) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const TestMotion motion = HandHeldMotion(-10.0);
    const TestSensors sensors;
    const TestRecording recording = Record(motion, RoomLandmarks(seed), sensors, 12.0, seed);
    const TestRun run(VioOptions(), TestRig(sensors), recording, motion);
    EXPECT_TRUE(run.HasNotice("started in motion"));
    EXPECT_LT(ToSeconds(run.estimates().front().state.time), 0.5);
    EXPECT_LT(run.LargestError(), 0.1) << "seed " << seed;
    EXPECT_NEAR(run.Scale(), 1.0, 0.01) << "seed " << seed;
    EXPECT_EQ(run.odometry().resets(), 0U);
  }
}

TEST(VisualInertialOdometry, ARoverAtRestDoesNotStartInMotion) {
  // Bearings too noisy to show rest: the start waits for the drive.
  TestSensors sensors = OnTheMoon();
  sensors.pixel_sigma = 0.7;
  const TestRecording recording = Record(RoverMotion(), GroundLandmarks(1), sensors, 8.0, 1);
  const TestRun run(VioOptions(), TestRig(sensors), recording, RoverMotion());
  EXPECT_GT(ToSeconds(run.estimates().front().state.time), 2.0);
}

TEST(VisualInertialOdometry, FindsTheCamerasTimeOffset) {
  for (const double offset : {0.004, -0.004}) {
    TestSensors sensors;
    sensors.time_offset = offset;
    const TestMotion motion = HandHeldMotion(2.0);
    const TestRecording recording = Record(motion, RoomLandmarks(5), sensors, 15.0, 5);
    RigCalibration rig = TestRig(sensors);
    rig.cameras["mono"].time_offset_sigma = 0.005;
    const TestRun run(VioOptions(), rig, recording, motion);
    EXPECT_NEAR(run.odometry().window().time_offset(), offset, 1e-3);
    EXPECT_LT(run.LargestError(), 0.1);
  }
}

TEST(VisualInertialOdometry, AnExactTimeOffsetStays) {
  TestSensors sensors;
  const TestMotion motion = HandHeldMotion(2.0);
  const TestRecording recording = Record(motion, RoomLandmarks(5), sensors, 6.0, 5);
  const TestRun run(VioOptions(), TestRig(sensors), recording, motion);
  EXPECT_EQ(run.odometry().window().time_offset(), 0.0);
}

TEST(VisualInertialOdometry, RefinesExtrinsicsAndTimeOffsetOnDemand) {
  TestSensors sensors;
  sensors.time_offset = 0.010;
  const TestMotion motion = HandHeldMotion(2.0);
  const TestRecording recording = Record(motion, RoomLandmarks(6), sensors, 25.0, 6);
  RigCalibration rig = TestRig(sensors);
  CameraCalibration& camera = rig.cameras["mono"];
  const Eigen::Vector3d axis = Eigen::Vector3d(0.5, -0.7, 0.6).normalized();
  camera.T_imu_camera.rotation = camera.T_imu_camera.rotation * ExpSo3(2.0 * kDegree * axis);
  camera.T_imu_camera.translation += 0.02 * Eigen::Vector3d(0.6, 0.5, -0.6).normalized();
  camera.time_offset_sigma = 0.010;
  VioOptions options;
  options.refine_extrinsics = true;
  options.extrinsics_rotation_sigma = 0.05;
  options.extrinsics_position_sigma = 0.03;
  const TestRun run(options, rig, recording, motion);
  const SE3 found = run.odometry().window().T_imu_camera();
  EXPECT_LT(AngleBetween(found.rotation, sensors.T_imu_camera.rotation), 0.2 * kDegree);
  EXPECT_LT((found.translation - sensors.T_imu_camera.translation).norm(), 0.005);
  EXPECT_NEAR(run.odometry().window().time_offset(), 0.010, 1e-3);
}

TEST(VisualInertialOdometry, AnswersForTimesBetweenImages) {
  const TestMotion motion = HandHeldMotion(2.0);
  const TestSensors sensors;
  const TestRecording recording = Record(motion, RoomLandmarks(5), sensors, 6.0, 5);
  VisualInertialOdometry odometry(VioOptions(), TestRig(sensors), "mono", "");
  for (const double time : {0.05, 3.03, 4.07, 5.0}) odometry.AddStamp(FromSeconds(time));
  std::vector<StampedState> stamped;
  std::optional<VioEstimate> first;
  size_t frame = 0;
  for (const ImuSample& sample : recording.imu) {
    while (frame < recording.frames.size() && recording.frames[frame].stamp <= sample.time) {
      odometry.AddFrame(recording.frames[frame++]);
    }
    for (const VioEstimate& estimate : odometry.AddImu(sample)) {
      if (!first) first = estimate;
    }
    for (const StampedState& state : odometry.TakeStamped()) stamped.push_back(state);
  }
  ASSERT_TRUE(first.has_value());
  ASSERT_EQ(stamped.size(), 4U);
  const SE3 T_world_true = first->state.T_world_imu *
                           TrueMotionAt(motion, ToSeconds(first->state.time)).T_world_imu.Inverse();
  for (const StampedState& state : stamped) {
    const SE3 truth = T_world_true * TrueMotionAt(motion, ToSeconds(state.time)).T_world_imu;
    EXPECT_LT((state.state.T_world_imu.translation - truth.translation).norm(), 0.05);
    const SE3 again = odometry.window().History().Pose(state.frame) * state.T_frame_imu;
    EXPECT_LT((again.translation - truth.translation).norm(), 0.05);
  }
}

TEST(VisualInertialOdometry, SaysThatGravityIsWrong) {
  TestSensors sensors = OnTheMoon();
  const TestRecording recording = Record(RoverMotion(), GroundLandmarks(1), sensors, 3.0, 1);
  RigCalibration rig = TestRig(sensors);
  rig.gravity = 9.81;
  VisualInertialOdometry odometry(VioOptions(), rig, "mono", "");
  odometry.AddFrame(recording.frames.front());
  EXPECT_THROW(
      {
        for (const ImuSample& sample : recording.imu) odometry.AddImu(sample);
      },
      InputError);
}

TEST(VisualInertialOdometry, SaysThatTheImuIsTooSlow) {
  TestSensors sensors = OnTheMoon();
  const TestRecording recording = Record(RoverMotion(), GroundLandmarks(1), sensors, 3.0, 1);
  VisualInertialOdometry odometry(VioOptions(), TestRig(sensors), "mono", "");
  size_t next = 0;
  for (size_t i = 0; i < recording.imu.size(); i += 8) {  // 25 Hz
    for (; next < recording.frames.size() && recording.frames[next].stamp <= recording.imu[i].time;
         ++next) {
      odometry.AddFrame(recording.frames[next]);
    }
    odometry.AddImu(recording.imu[i]);
  }
  EXPECT_FALSE(odometry.is_running());
  const std::vector<std::string> notices = odometry.Notices();
  EXPECT_TRUE(std::any_of(notices.begin(), notices.end(), [](const std::string& notice) {
    return notice.find("25 Hz, below 50 Hz") != std::string::npos;
  }));
}

}  // namespace
}  // namespace regolith
