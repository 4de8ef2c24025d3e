// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/stereo_matcher.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

CameraIntrinsics Intrinsics() {
  CameraIntrinsics intrinsics;
  intrinsics.width = 320;
  intrinsics.height = 240;
  intrinsics.focal = {200.0, 200.0};
  intrinsics.principal_point = {159.5, 119.5};
  return intrinsics;
}

/// Smooth random texture.
Image Textured(double shift) {
  Image image{320, 240, std::vector<uint8_t>(320 * 240)};
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      double value = 128.0;
      for (int wave = 1; wave <= 6; ++wave) {
        const double phase = 6.28 * HashUniform(3, static_cast<uint64_t>(wave));
        value += 18.0 * std::sin(0.05 * wave * (x + shift) + phase) *
                 std::cos(0.043 * wave * y + 2.0 * phase);
      }
      image.data[static_cast<size_t>(y * 320 + x)] = static_cast<uint8_t>(value);
    }
  }
  return image;
}

std::vector<TrackedFeature> Grid() {
  const auto camera = CameraModel::Create(Intrinsics());
  std::vector<TrackedFeature> features;
  for (int y = 40; y < 200; y += 20) {
    for (int x = 60; x < 260; x += 20) {
      TrackedFeature feature;
      feature.pixel = Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y));
      feature.bearing = *camera->Unproject(feature.pixel.cast<double>());
      features.push_back(feature);
    }
  }
  return features;
}

const SE3 kPair(Eigen::Quaterniond::Identity(), {0.12, 0.0, 0.0});

TEST(StereoMatcher, FindsTheDisparityOfAWall) {
  // Eight pixels of disparity: 3 m away.
  StereoMatcher matcher(OpticalFlowOptions(), Intrinsics(), kPair);
  const std::vector<TrackedFeature> features = Grid();
  const auto bearings = matcher.Match(Textured(0.0), Textured(8.0), features);
  size_t found = 0;
  for (size_t i = 0; i < features.size(); ++i) {
    if (!bearings[i]) continue;
    ++found;
    const double disparity = 200.0 * (features[i].bearing.x() / features[i].bearing.z() -
                                      bearings[i]->x() / bearings[i]->z());
    EXPECT_NEAR(disparity, 8.0, 0.2);
  }
  EXPECT_GT(found, features.size() * 8 / 10);
}

TEST(StereoMatcher, SwappedEyesAreNotBelieved) {
  StereoMatcher matcher(OpticalFlowOptions(), Intrinsics(), kPair);
  const std::vector<TrackedFeature> features = Grid();
  for (const auto& bearing : matcher.Match(Textured(8.0), Textured(0.0), features)) {
    EXPECT_FALSE(bearing);
  }
}

TEST(StereoMatcher, ABlackEyeGivesNothing) {
  StereoMatcher matcher(OpticalFlowOptions(), Intrinsics(), kPair);
  const Image black{320, 240, std::vector<uint8_t>(320 * 240)};
  for (const auto& bearing : matcher.Match(Textured(0.0), black, Grid())) EXPECT_FALSE(bearing);
}

}  // namespace
}  // namespace regolith
