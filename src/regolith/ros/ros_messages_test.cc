// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/ros/ros_messages_internal.h"

namespace regolith {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using testing::HasSubstr;

const SE3 kTurnedLeft(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ())),
                      Eigen::Vector3d(1.0, 2.0, 3.0));

TEST(RosMessages, OdometryIsOfTheBaseWithItsVelocityInItsOwnFrame) {
  NavState state;
  state.time = FromSeconds(12.5);
  state.T_world_imu = kTurnedLeft;
  state.v_world_imu = {0.0, 0.5, 0.0};  // ahead
  // The base lies 0.4 m behind and below the IMU; the body turns left.
  const SE3 T_imu_base(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-0.4, 0.0, -0.4));
  const auto message =
      OdometryMessage(state, Eigen::Vector3d(0.0, 0.0, 0.1), T_imu_base, "odom", "base_link");
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "base_link");
  EXPECT_EQ(message.header.stamp.sec, 12U);
  EXPECT_NEAR(message.pose.pose.position.x, 1.0, 1e-12);
  EXPECT_NEAR(message.pose.pose.position.y, 1.6, 1e-12);
  EXPECT_NEAR(message.pose.pose.position.z, 2.6, 1e-12);
  EXPECT_NEAR(message.twist.twist.linear.x, 0.5, 1e-12);
  EXPECT_NEAR(message.twist.twist.linear.y, -0.04, 1e-12);
  EXPECT_NEAR(message.twist.twist.angular.z, 0.1, 1e-12);
}

TEST(RosMessages, CovarianceGoesToTheOrderAndTheAxesOfRos) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance(0, 0) = 4.0;  // roll
  covariance(4, 4) = 9.0;  // y
  const auto message = PoseWithCovariance(FromSeconds(1.0), kTurnedLeft, covariance, "map");
  EXPECT_NEAR(message.pose.covariance[1 * 6 + 1], 9.0, 1e-12);
  // The body's x axis lies along the map's y.
  EXPECT_NEAR(message.pose.covariance[4 * 6 + 4], 4.0, 1e-12);
  EXPECT_NEAR(message.pose.covariance[3 * 6 + 3], 0.0, 1e-12);
}

TEST(RosMessages, FeaturesAreDrawnInsideTheImageOnly) {
  CameraFrame frame;
  frame.image.width = 10;
  frame.image.height = 8;
  frame.image.data.assign(80, 50);
  std::vector<TrackedFeature> features(2);
  features[0].pixel = {0.0F, 0.0F};
  features[1].pixel = {9.4F, 7.2F};
  const auto image = FeaturesMessage(frame, features);
  ASSERT_EQ(image.data.size(), 240U);
  EXPECT_NE(image.data[0], 50);
  EXPECT_NE(image.data[3 * (7 * 10 + 9)], 50);
  EXPECT_EQ(image.data[3 * (4 * 10 + 5)], 50);
}

TEST(RosMessages, CloudsHaveFourFloatsAPoint) {
  const std::vector<MapPoint> points(3, {Eigen::Vector3f(1.0F, 2.0F, 3.0F), 4.0F});
  const auto cloud = CloudMessage(FromSeconds(1.0), points, "map");
  EXPECT_EQ(cloud.width, 3U);
  EXPECT_EQ(cloud.point_step, 16U);
  EXPECT_EQ(cloud.data.size(), 48U);
  EXPECT_EQ(cloud.fields.size(), 4U);
}

TEST(RosMessages, DiagnosticsSayWhatIsMissingAndWhatIsDropped) {
  const TopicInput lidar({"lidar", "/points", {"sensor_msgs/PointCloud2"}, {}}, RigCalibration());
  TopicStatus status;
  auto message = TopicDiagnostics("regolith", lidar, status, {}, 2.0, " /scans");
  EXPECT_EQ(message.level, DiagnosticStatus::ERROR);
  EXPECT_THAT(message.message, HasSubstr("/points"));
  EXPECT_THAT(message.message, HasSubstr("there is /scans"));
  status.messages = 100;
  status.age = 0.1;
  EXPECT_EQ(TopicDiagnostics("regolith", lidar, status, {}, 2.0, "").level, DiagnosticStatus::OK);
  EventMerger::Dropped dropped;
  dropped.late = 3;
  message = TopicDiagnostics("regolith", lidar, status, dropped, 2.0, "");
  EXPECT_EQ(message.level, DiagnosticStatus::WARN);
  EXPECT_THAT(message.message, HasSubstr("3 of 100"));
  status.age = 4.0;
  EXPECT_EQ(TopicDiagnostics("regolith", lidar, status, {}, 2.0, "").level,
            DiagnosticStatus::STALE);
}

TEST(RosMessages, ANodeThatCannotFollowSaysSo) {
  PipelineDiagnostics state;
  state.has_pose = true;
  state.leader = "lidar+imu";
  EXPECT_EQ(PipelineMessage("regolith", state).level, DiagnosticStatus::OK);
  state.newly_dropped = 2;
  state.live.dropped_scans = 2;
  const auto message = PipelineMessage("regolith", state);
  EXPECT_EQ(message.level, DiagnosticStatus::WARN);
  EXPECT_THAT(message.message, HasSubstr("2 scans"));
}

TEST(RosMessages, AStartWithoutPosesHasNoPathAndNoLoops) {
  RigCalibration rig;
  rig.lidar.emplace();
  ThreadPool threads(1);
  const SlamSystem system({}, rig, &threads);
  EXPECT_TRUE(KeyPoses(system, SE3()).empty());
  EXPECT_TRUE(PathMessage({}, "map").poses.empty());
  EXPECT_TRUE(LoopsMessage(system, 0, SE3(), "map").markers.empty());
}

TEST(RosMessages, APathHasAStampAPose) {
  const std::vector<StampedPose> poses = {{FromSeconds(1.0), SE3()},
                                          {FromSeconds(2.0), kTurnedLeft}};
  const auto path = PathMessage(poses, "map");
  ASSERT_EQ(path.poses.size(), 2U);
  EXPECT_EQ(path.poses[0].header.stamp.sec, 1U);
  EXPECT_EQ(path.header.stamp.sec, 2U);
  EXPECT_EQ(path.poses[1].pose.position.y, 2.0);
}

}  // namespace
}  // namespace regolith
