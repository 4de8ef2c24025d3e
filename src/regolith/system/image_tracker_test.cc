// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/image_tracker.h"

#include <gtest/gtest.h>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kFocal = 1500.0;

RigCalibration Rig() {
  RigCalibration rig;
  rig.imu.emplace();
  CameraCalibration& camera = rig.cameras["mono"];
  camera.intrinsics.width = kWidth;
  camera.intrinsics.height = kHeight;
  camera.intrinsics.focal = {kFocal, kFocal};
  camera.intrinsics.principal_point = {159.5, 119.5};
  // The camera looks along the IMU's x axis; its y axis points along −z.
  Eigen::Matrix3d R_imu_camera;
  R_imu_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  camera.T_imu_camera = {Eigen::Quaterniond(R_imu_camera), {0.5, 0.0, 0.3}};
  return rig;
}

PipelineOptions Options(const std::string& frontend) {
  PipelineOptions options;
  options.tracked_camera = "mono";
  options.features.frontend = frontend;
  options.features.max_keypoints = 150;
  return options;
}

/// Squares of random greys, as seen by a camera that turns to the right by `shift` pixels.
Image Squares(int shift) {
  Image image{kWidth, kHeight, std::vector<uint8_t>(kWidth * kHeight)};
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const auto x = static_cast<uint64_t>((column + shift) / 11);
      const auto y = static_cast<uint64_t>(row / 11);
      image.data[static_cast<size_t>(row * kWidth + column)] =
          static_cast<uint8_t>(255.0 * HashUniform(3, x, y));
    }
  }
  return image;
}

// A turn of 70 pixels a frame, further than tracks are looked for without a gyro.
int TrackedInATurn(const std::string& frontend, bool with_imu) {
  ImageTracker tracker(Options(frontend), Rig(), std::nullopt);
  const double rate = 10.0 * std::atan(70.0 / kFocal);
  int tracked = 0;
  for (int frame = 0; frame < 3; ++frame) {
    for (int i = 0; with_imu && i < 20; ++i) {
      ImuSample sample;
      sample.time = FromSeconds(1.0 + 0.1 * (frame - 1) + 0.005 * (i + 1));
      sample.angular_velocity = {0.01, 0.02, -rate};  // to the right is about −z
      tracker.AddImu(sample);
    }
    tracker.SetGyroBias({0.01, 0.02, 0.0});
    tracked = tracker.Track(FromSeconds(1.0 + 0.1 * frame), Squares(70 * frame)).status.tracked;
  }
  return tracked;
}

TEST(ImageTracker, FollowsAFastTurnByTheGyro) {
  EXPECT_GT(TrackedInATurn("orb", true), 35);
  EXPECT_GT(TrackedInATurn("orb", true), 2 * TrackedInATurn("orb", false));
  EXPECT_GT(TrackedInATurn("st_lk", true), 50);
}

TEST(ImageTracker, KeepsOffTheRoversOwnParts) {
  Image mask{kWidth, kHeight, std::vector<uint8_t>(kWidth * kHeight, 255)};
  std::fill(mask.data.begin() + kWidth * 150, mask.data.end(), uint8_t{0});
  ImageTracker tracker(Options("st_lk"), Rig(), mask);
  for (int frame = 0; frame < 3; ++frame) {
    const TrackedFrame tracked = tracker.Track(FromSeconds(0.1 * frame), Squares(3 * frame));
    EXPECT_GT(tracked.features.size(), 50U);
    for (const TrackedFeature& feature : tracked.features) EXPECT_LT(feature.pixel.y(), 149.6F);
  }
  mask.height = 10;
  EXPECT_THROW(ImageTracker(Options("st_lk"), Rig(), mask), CheckError);
}

TEST(ImageTracker, NeedsItsCameraInTheRig) {
  PipelineOptions options = Options("orb");
  options.tracked_camera = "left";
  EXPECT_THROW(ImageTracker(options, Rig(), std::nullopt), CheckError);
}

}  // namespace
}  // namespace regolith
