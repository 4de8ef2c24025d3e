// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/stereo_rectifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regolith/core/error.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

CameraIntrinsics Distorted(double focal, double k1) {
  CameraIntrinsics intrinsics;
  intrinsics.width = 640;
  intrinsics.height = 480;
  intrinsics.focal = {focal, focal + 2.0};
  intrinsics.principal_point = {322.0, 238.0};
  intrinsics.distortion = {k1, 0.02, 0.001, -0.0005};
  return intrinsics;
}

/// A white spot where a camera sees a point.
Image Spot(const CameraIntrinsics& intrinsics, const Eigen::Vector3d& point_camera) {
  const Eigen::Vector2d centre = *CameraModel::Create(intrinsics)->Project(point_camera);
  Image image{640, 480, std::vector<uint8_t>(640 * 480)};
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double square = (Eigen::Vector2d(x, y) - centre).squaredNorm();
      image.data[static_cast<size_t>(640 * y + x)] =
          static_cast<uint8_t>(std::lround(250.0 * std::exp(-0.1 * square)));
    }
  }
  return image;
}

Eigen::Vector2d CentreOf(const Image& image) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      sum += image.At(x, y) * Eigen::Vector2d(x, y);
      weight += image.At(x, y);
    }
  }
  return sum / weight;
}

TEST(StereoRectifier, APointLiesInOneRowAtItsDisparity) {
  const CameraIntrinsics left = Distorted(381.0, -0.08);
  const CameraIntrinsics right = Distorted(390.0, -0.05);
  const SE3 T_left_right(ExpSo3({0.02, -0.03, 0.015}), {0.12, 0.004, -0.003});
  const StereoRectifier rectifier(left, right, T_left_right);
  const RectifiedCamera& camera = rectifier.camera();
  EXPECT_NEAR(camera.baseline, T_left_right.translation.norm(), 1e-12);
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0.3, 0.2, 2.0), Eigen::Vector3d(-1.0, 0.5, 3.0),
        Eigen::Vector3d(2.0, -1.0, 6.0)}) {
    const Eigen::Vector3d expected = camera.Project(rectifier.T_left_rectified().Inverse() * point);
    const Eigen::Vector2d seen_left = CentreOf(rectifier.Left(Spot(left, point)));
    const Eigen::Vector2d seen_right =
        CentreOf(rectifier.Right(Spot(right, T_left_right.Inverse() * point)));
    EXPECT_LT((seen_left - expected.head<2>()).norm(), 0.1);
    EXPECT_NEAR(seen_right.y(), expected.y(), 0.1);
    EXPECT_NEAR(seen_right.x(), expected.z(), 0.1);
  }
}

TEST(StereoRectifier, MasksLeaveOutWhatIsNotSeen) {
  const CameraIntrinsics intrinsics = Distorted(381.0, -0.08);
  const StereoRectifier rectifier(intrinsics, intrinsics, SE3({1, 0, 0, 0}, {0.12, 0.0, 0.0}));
  Image own{640, 480, std::vector<uint8_t>(640 * 480, 255)};
  std::fill(own.data.begin() + 640 * 400, own.data.end(), uint8_t{0});
  const Image mask = rectifier.LeftMask(&own);
  EXPECT_EQ(mask.At(320, 240), 255);
  EXPECT_EQ(mask.At(320, 440), 0);
  EXPECT_EQ(rectifier.LeftMask(nullptr).At(320, 440), 255);
  // The corners of a rectified image reach beyond what a pincushion sees.
  const StereoRectifier pincushion(Distorted(381.0, 0.2), Distorted(381.0, 0.2),
                                   SE3({1, 0, 0, 0}, {0.12, 0.0, 0.0}));
  EXPECT_EQ(pincushion.RightMask().At(0, 0), 0);
  EXPECT_EQ(pincushion.RightMask().At(320, 240), 255);
}

TEST(StereoRectifier, ARightEyeOnTheLeftIsRefused) {
  const CameraIntrinsics intrinsics = Distorted(381.0, -0.08);
  EXPECT_THROW(StereoRectifier(intrinsics, intrinsics, SE3({1, 0, 0, 0}, {-0.12, 0.0, 0.0})),
               InputError);
  EXPECT_THROW(StereoRectifier(intrinsics, intrinsics, SE3({1, 0, 0, 0}, {0.0, 0.0, 0.12})),
               InputError);
}

}  // namespace
}  // namespace regolith
