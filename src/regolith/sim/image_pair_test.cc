// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/image_pair.h"

#include <cmath>

#include <gtest/gtest.h>

#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

// A level plane, and a wall across the view where x reaches `wall_at`.
class PlaneSurface : public Surface {
 public:
  double Height(double x, double, double) const override {
    return x > wall_at && x < wall_at + 0.5 ? 0.6 : 0.0;
  }
  double Albedo(double, double, double) const override { return 0.12; }
  bool Known(double, double, double) const override { return true; }
  Eigen::AlignedBox2d box() const override {
    return {Eigen::Vector2d(-50.0, -50.0), Eigen::Vector2d(50.0, 50.0)};
  }
  double wall_at = 1e9;
};

class ImagePairTest : public testing::Test {
 protected:
  ImagePair Find(const SE3& T_world_first, const SE3& T_world_second) {
    MeshOptions mesh;
    mesh.spacing = 0.04;
    mesh.reach = 100.0;
    const auto scene = Scene::Create(ground_, path_, {}, photometry_, mesh, &pool_);
    const Renderer renderer(intrinsics_, *scene, photometry_, &pool_);
    ImagePair pair;
    FindFlow(*scene, renderer, intrinsics_, T_world_first, T_world_second, &pool_, &pair);
    return pair;
  }
  // A camera at (x, y, 1.1), 15 degrees down, turned to the left by `yaw`.
  static SE3 Camera(double x, double y, double yaw) {
    return SE3(Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())),
               Eigen::Vector3d(x, y, 0.0)) *
           BaseFromCamera(CameraOptions{}, "mono");
  }
  size_t Pixel(int column, int row) const {
    return static_cast<size_t>(row * intrinsics_.width + column);
  }

  ThreadPool pool_{2};
  PlaneSurface surface_;
  Ground ground_{surface_, Eigen::Vector3d::Zero()};
  std::vector<Eigen::Vector2d> path_ = {{0.0, 0.0}, {1.0, 0.0}};
  Photometry photometry_{"moon", SunOptions{}, 0.12};
  CameraIntrinsics intrinsics_ = MakeIntrinsics(CameraOptions{});
};

// Where a ray of the first camera meets the plane and where the second sees that place.
TEST_F(ImagePairTest, FlowOfAPlaneIsThatOfItsHomography) {
  const SE3 T_world_first = Camera(0.0, 0.0, 0.0);
  const SE3 T_world_second = Camera(0.4, -0.1, 0.15);
  const ImagePair pair = Find(T_world_first, T_world_second);
  const auto model = CameraModel::Create(intrinsics_);
  int known = 0;
  for (int row = 0; row < intrinsics_.height; row += 7) {
    for (int column = 0; column < intrinsics_.width; column += 7) {
      const float x = pair.flow_x[Pixel(column, row)];
      const Eigen::Vector3d ray =
          T_world_first.rotation * *model->Unproject(Eigen::Vector2d(column, row));
      if (ray.z() >= 0.0) {
        EXPECT_TRUE(std::isnan(x)) << "sky at " << column << ", " << row;
        continue;
      }
      const Eigen::Vector3d place =
          T_world_first.translation - ray * (T_world_first.translation.z() / ray.z());
      if (place.norm() > 40.0) continue;
      const auto pixel = model->Project(T_world_second.Inverse() * place);
      const bool seen = pixel && pixel->x() > 0.0 && pixel->y() > 0.0 &&
                        pixel->x() < intrinsics_.width - 1 && pixel->y() < intrinsics_.height - 1;
      if (!seen) continue;
      ++known;
      EXPECT_NEAR(x, pixel->x(), 0.02);
      EXPECT_NEAR(pair.flow_y[Pixel(column, row)], pixel->y(), 0.02);
    }
  }
  EXPECT_GT(known, 1000);
}

TEST_F(ImagePairTest, StayingIsNoFlow) {
  const ImagePair pair = Find(Camera(0.0, 0.0, 0.0), Camera(0.0, 0.0, 0.0));
  EXPECT_NEAR(pair.flow_x[Pixel(320, 400)], 320.0, 1e-2);
  EXPECT_NEAR(pair.flow_y[Pixel(320, 400)], 400.0, 1e-2);
}

// The first camera looks over a wall's top at the ground behind; from further back, and lower in
// the view, the wall hides it.
TEST_F(ImagePairTest, WhatAWallHidesHasNoFlow) {
  surface_.wall_at = 3.0;
  const auto model = CameraModel::Create(intrinsics_);
  const SE3 T_world_first = Camera(2.2, 0.0, 0.0);
  const SE3 T_world_second = Camera(-2.0, 0.0, 0.0);
  const Eigen::Vector3d behind(5.2, 0.0, 0.0);
  const auto pixel = model->Project(T_world_first.Inverse() * behind);
  ASSERT_TRUE(pixel.has_value());
  const size_t place =
      Pixel(static_cast<int>(std::lround(pixel->x())), static_cast<int>(std::lround(pixel->y())));
  EXPECT_TRUE(std::isnan(Find(T_world_first, T_world_second).flow_x[place]));
  surface_.wall_at = 1e9;
  EXPECT_FALSE(std::isnan(Find(T_world_first, T_world_second).flow_x[place]));
}

}  // namespace
}  // namespace regolith
