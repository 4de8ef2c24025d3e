// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/stereo_pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regolith/core/error.h"
#include "regolith/core/random.h"
#include "regolith/system/slam_system.h"

namespace regolith {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kBaseline = 0.12;  // m

/// A wall of spots before a camera that has moved to the right by `shift` pixels.
Image Wall(double shift) {
  std::vector<float> grey(kWidth * kHeight, 110.0F);
  Random random(5);
  for (int i = 0; i < 1500; ++i) {
    const Eigen::Vector2d centre(random.Uniform(-50, kWidth + 150) - shift,
                                 random.Uniform(0, kHeight));
    const double radius = random.Uniform(1.5, 4.0);
    const double height = random.Uniform(-60, 60);
    const int reach = static_cast<int>(3.0 * radius);
    for (int y = std::max(0, static_cast<int>(centre.y()) - reach);
         y < std::min(kHeight, static_cast<int>(centre.y()) + reach); ++y) {
      for (int x = std::max(0, static_cast<int>(centre.x()) - reach);
           x < std::min(kWidth, static_cast<int>(centre.x()) + reach); ++x) {
        const double square = (Eigen::Vector2d(x, y) - centre).squaredNorm() / (radius * radius);
        grey[static_cast<size_t>(y * kWidth + x)] +=
            static_cast<float>(height / (1.0 + square * square * square));
      }
    }
  }
  Image image{kWidth, kHeight, std::vector<uint8_t>(kWidth * kHeight)};
  for (size_t i = 0; i < grey.size(); ++i) {
    image.data[i] = static_cast<uint8_t>(std::clamp(std::lround(grey[i]), 0L, 255L));
  }
  return image;
}

Image Black() { return {kWidth, kHeight, std::vector<uint8_t>(kWidth * kHeight, 2)}; }

/// Cameras that look along the body's x axis.
RigCalibration Rig(double baseline) {
  RigCalibration rig;
  Eigen::Matrix3d R_body_camera;
  R_body_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  for (const auto& [name, side] : {std::pair("left", 0.5), std::pair("right", -0.5)}) {
    CameraCalibration& camera = rig.cameras[name];
    camera.intrinsics.width = kWidth;
    camera.intrinsics.height = kHeight;
    camera.intrinsics.focal = {200.0, 200.0};
    camera.intrinsics.principal_point = {159.5, 119.5};
    camera.T_imu_camera = SE3(Eigen::Quaterniond(R_body_camera), {0.3, side * baseline, 0.9});
  }
  return rig;
}

PipelineOptions Options() {
  PipelineOptions options;
  options.name = "orb_slam2";
  options.odometry = OdometryKind::kStereo;
  options.tracked_camera = "left";
  options.features.frontend = "orb";
  options.features.max_keypoints = 600;
  return options;
}

constexpr double kDisparity = 12.0;      // pixels: 2 m away
constexpr double kPixelsAMetre = 100.0;  // the wall's shift as the rover goes sideways

class StereoPipelineTest : public testing::Test {
 protected:
  /// The rover goes to the right, 2 cm an image.
  void Feed(int images, double late = 0.0, bool exchanged = false, bool black = false) {
    for (int i = 0; i < images; ++i, ++count_) {
      const double shift = 0.02 * kPixelsAMetre * count_;
      Image left = Wall(shift);
      Image right = black ? Black() : Wall(shift + kDisparity);
      if (exchanged) std::swap(left, right);
      const TimeNs time = FromSeconds(0.1 * count_);
      for (const FrameReport& report : system_.Process(CameraFrame{time, "left", left})) {
        reports_.push_back(report);
      }
      for (const FrameReport& report :
           system_.Process(CameraFrame{time + FromSeconds(late), "right", right})) {
        reports_.push_back(report);
      }
    }
  }

  StereoHealth LastHealth() const { return reports_.back().stereo->health; }

  ThreadPool threads_{2};
  SlamSystem system_{Options(), Rig(kBaseline), &threads_};
  std::vector<FrameReport> reports_;
  int count_ = 0;
};

TEST_F(StereoPipelineTest, FollowsAPairFromTheFirstBodyPoseOn) {
  EXPECT_EQ(system_.needs().cameras, (std::vector<std::string>{"left", "right"}));
  EXPECT_FALSE(system_.needs().imu);
  Feed(15);
  ASSERT_EQ(reports_.size(), 15U);
  EXPECT_EQ(LastHealth(), StereoHealth::kGood);
  const Trajectory trajectory = system_.trajectory();
  ASSERT_EQ(trajectory.size(), 15U);
  EXPECT_LT(trajectory.poses()[0].T_world_body.translation.norm(), 1e-9);
  EXPECT_LT(
      (trajectory.poses()[14].T_world_body.translation - Eigen::Vector3d(0.0, -0.28, 0.0)).norm(),
      0.01);
  EXPECT_GT(system_.MapPoints().size(), 100U);
  EXPECT_TRUE(system_.Notices().empty());
}

TEST_F(StereoPipelineTest, PosesStandAtTheScansWhereThereAreAny) {
  Feed(5);
  LidarScan scan;
  for (const double time : {0.42, 0.45, 0.55}) {
    scan.stamp = FromSeconds(time);
    system_.Process(scan);
  }
  Feed(5);
  const Trajectory trajectory = system_.trajectory();
  ASSERT_EQ(trajectory.size(), 3U);
  EXPECT_EQ(trajectory.poses()[1].time, FromSeconds(0.45));
  EXPECT_NEAR(trajectory.poses()[1].T_world_body.translation.y(), -0.09, 0.005);
}

TEST_F(StereoPipelineTest, AnEyeThatIsLateMakesNoPair) {
  Feed(6, 0.05);
  system_.Finish();
  EXPECT_TRUE(system_.trajectory().empty());
  EXPECT_EQ(LastHealth(), StereoHealth::kNoPair);
  ASSERT_EQ(system_.Notices().size(), 1U);
  EXPECT_NE(system_.Notices()[0].find("no right one"), std::string::npos);
}

TEST_F(StereoPipelineTest, ABlackEyeIsNoStart) {
  Feed(4, 0.0, false, true);
  EXPECT_EQ(LastHealth(), StereoHealth::kNotStarted);
  EXPECT_TRUE(system_.trajectory().empty());
  ASSERT_EQ(system_.Notices().size(), 1U);
  EXPECT_NE(system_.Notices()[0].find("both eyes"), std::string::npos);
}

TEST_F(StereoPipelineTest, ExchangedImagesAreAnError) {
  EXPECT_THROW(Feed(8, 0.0, true), InputError);
  EXPECT_TRUE(system_.trajectory().empty());
}

TEST_F(StereoPipelineTest, NothingIsSaidWhileItIsLost) {
  Feed(10);
  const size_t before = system_.trajectory().size();
  for (int i = 0; i < 5; ++i, ++count_) {
    system_.Process(CameraFrame{FromSeconds(0.1 * count_), "left", Black()});
    reports_ = system_.Process(CameraFrame{FromSeconds(0.1 * count_), "right", Black()});
    EXPECT_EQ(LastHealth(), StereoHealth::kLost);
    EXPECT_TRUE(reports_.back().leader.empty());
  }
  EXPECT_EQ(system_.trajectory().size(), before);
  Feed(3);
  EXPECT_EQ(LastHealth(), StereoHealth::kGood);
  EXPECT_EQ(system_.trajectory().size(), before + 3);
  EXPECT_NE(system_.Notices()[0].find("lost 1 times: 5"), std::string::npos);
}

TEST(StereoPipelineRig, APairWithoutABaselineIsRefused) {
  ThreadPool threads(1);
  try {
    SlamSystem(Options(), Rig(0.0), &threads);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("pipeline orb_slam2"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("T_imu_camera"), std::string::npos);
  }
  EXPECT_THROW(SlamSystem(Options(), Rig(-kBaseline), &threads), InputError);
  RigCalibration one_eye = Rig(kBaseline);
  one_eye.cameras.erase("right");
  EXPECT_THROW(SlamSystem(Options(), one_eye, &threads), InputError);
}

}  // namespace
}  // namespace regolith
