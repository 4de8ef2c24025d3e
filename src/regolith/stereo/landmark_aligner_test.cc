// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/landmark_aligner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regolith/stereo/test_stereo_world_internal.h"

namespace regolith {
namespace {

/// Where a pixel's ray meets level ground, m in the world.
Eigen::Vector3d GroundAt(const SE3& T_world_camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d ray = T_world_camera.rotation * kTestCamera.PointAt(pixel, 1.0);
  return T_world_camera.translation - ray * (T_world_camera.translation.z() / ray.z());
}

/// Grey level of the ground: waves of 6 cm and more, for a patch that lies on a part of one has no
/// more than a plane.
double Grey(const Eigen::Vector3d& place) {
  double sum = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double direction = 2.4 * i;
    const double number = 105.0 - 6.0 * i;  // rad/m
    sum += std::sin(number * (std::cos(direction) * place.x() + std::sin(direction) * place.y()) +
                    1.7 * i);
  }
  return 128.0 + 18.0 * sum;
}

Image Seen(const SE3& T_world_camera) {
  Image image{kTestCamera.width, kTestCamera.height, {}};
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const Eigen::Vector3d ground = GroundAt(T_world_camera, {column, std::max(row, 200)});
      image.data.push_back(static_cast<uint8_t>(std::clamp(std::lround(Grey(ground)), 0L, 255L)));
    }
  }
  return image;
}

/// Keypoints in the lower part of the image, with distances and patches.
StereoFeatures FeaturesOf(const SE3& T_world_camera, const Image& image,
                          const std::vector<Eigen::Vector2d>& pixels) {
  StereoFeatures features;
  for (const Eigen::Vector2d& pixel : pixels) {
    const Eigen::Vector3d seen =
        kTestCamera.Project(T_world_camera.Inverse() * GroundAt(T_world_camera, pixel));
    features.pixels.push_back(pixel.cast<float>());
    features.right_columns.push_back(static_cast<float>(seen.z()));
    features.scales.push_back(1.0F);
    features.patches.push_back(CutPatch(image, features.pixels.back()));
  }
  return features;
}

std::vector<Eigen::Vector2d> Grid() {
  std::vector<Eigen::Vector2d> pixels;
  for (double row = 250.0; row < 440.0; row += 23.7) {
    for (double column = 120.0; column < 520.0; column += 29.3) pixels.emplace_back(column, row);
  }
  return pixels;
}

TEST(DisparitySlopes, AreThoseOfLevelGround) {
  const SE3 pose = TestCameraPose(0.0, 0.0, 0.0);
  const Image image = Seen(pose);
  const StereoFeatures features = FeaturesOf(pose, image, Grid());
  // Disparity is affine in the pixel: baseline over height, over the cosine of the tilt.
  const auto disparity = [&](double row) {
    const Eigen::Vector2d pixel(300.0, row);
    return pixel.x() - kTestCamera.Project(pose.Inverse() * GroundAt(pose, pixel)).z();
  };
  const double expected = (disparity(400.0) - disparity(300.0)) / 100.0;
  EXPECT_GT(expected, 0.09);
  for (const Eigen::Vector2f& slope : DisparitySlopes(features)) {
    EXPECT_NEAR(slope.x(), 0.0, 0.01);
    EXPECT_NEAR(slope.y(), expected, 0.25 * expected);
  }
}

TEST(LandmarkAligner, KeypointsAreMovedToTheirLandmarksThoughTheGroundIsSeenFromElsewhere) {
  const SE3 before = TestCameraPose(0.0, 0.0, 0.0);
  const SE3 now = TestCameraPose(0.5, 0.05, 0.08);
  const Image image_before = Seen(before);
  const Image image_now = Seen(now);
  StereoMap map(kTestCamera);
  StereoKeyframe keyframe;
  keyframe.T_world_camera = before;
  keyframe.features = FeaturesOf(before, image_before, Grid());
  keyframe.features.slopes = DisparitySlopes(keyframe.features);
  const size_t count = keyframe.features.size();
  keyframe.features.descriptors = {DescriptorType::kFloat, 1, std::vector<float>(count, 1.0F), {}};
  keyframe.landmarks.assign(count, kNoId);
  const KeyframeId id = map.AddKeyframe(std::move(keyframe)).id;

  const LandmarkAligner aligner(PatchAlignmentOptions(), kTestCamera);
  std::vector<double> errors;
  std::vector<double> disparities;
  size_t in_view = 0;
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d point =
        GroundAt(before, map.keyframe(id).features.pixels[i].cast<double>());
    const Eigen::Vector3d wanted = kTestCamera.Project(now.Inverse() * point);
    if (wanted.y() > 465.0 || wanted.x() < 15.0 || wanted.x() > 625.0) continue;
    ++in_view;
    const LandmarkId landmark = map.AddLandmark(point, id, i);
    // Detected beside it, with the disparity of the ground there.
    const Eigen::Vector2d detected = wanted.head<2>() + Eigen::Vector2d(0.8, -0.6);
    StereoFeatures seen = FeaturesOf(now, image_now, {detected});
    if (!aligner.Align(map, *map.Find(landmark), now, &seen, 0)) continue;
    errors.push_back((seen.pixels[0].cast<double>() - wanted.head<2>()).norm());
    const double disparity = seen.pixels[0].x() - seen.right_columns[0];
    EXPECT_NEAR(disparity, wanted.x() - wanted.z(), 0.2);
    disparities.push_back(std::abs(disparity - (wanted.x() - wanted.z())));
  }
  ASSERT_GT(in_view, 60U);
  ASSERT_GT(errors.size(), in_view * 8 / 10);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.06);
  EXPECT_LT(errors[errors.size() * 9 / 10], 0.2);
  // 0.6 pixels lower the ground is nearer by 0.065 pixels of disparity.
  std::sort(disparities.begin(), disparities.end());
  EXPECT_LT(disparities[disparities.size() / 2], 0.02);
}

TEST(LandmarkAligner, OtherGroundIsRefusedAndFeaturesWithoutPatchesStay) {
  const SE3 pose = TestCameraPose(0.0, 0.0, 0.0);
  const Image image = Seen(pose);
  const Image elsewhere = Seen(TestCameraPose(3.0, 2.0, 0.5));
  StereoKeyframe keyframe;
  keyframe.T_world_camera = pose;
  keyframe.features = FeaturesOf(pose, image, Grid());
  keyframe.features.slopes = DisparitySlopes(keyframe.features);
  const LandmarkAligner aligner(PatchAlignmentOptions(), kTestCamera);
  StereoFeatures other = FeaturesOf(pose, elsewhere, Grid());
  size_t accepted = 0;
  for (size_t i = 0; i < other.size(); ++i) {
    const Eigen::Vector3d point = GroundAt(pose, other.pixels[i].cast<double>());
    accepted += aligner.Align(keyframe, i, point, pose, &other, i) ? 1 : 0;
  }
  EXPECT_LT(accepted, other.size() / 10);
  StereoFeatures without = FeaturesOf(pose, elsewhere, Grid());
  without.patches.clear();
  const Eigen::Vector2f place = without.pixels[0];
  EXPECT_TRUE(aligner.Align(keyframe, 0, GroundAt(pose, place.cast<double>()), pose, &without, 0));
  EXPECT_EQ(without.pixels[0], place);
}

}  // namespace
}  // namespace regolith
