// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/scene.h"

#include <cmath>

#include <gtest/gtest.h>

#include "regolith/sim/nearby_view.h"
#include "regolith/sim/renderer.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/tile_tree.h"

namespace regolith {
namespace {

// Gentle waves, a step wall where asked for, and rocks that the test lays.
class TestSurface : public Surface {
 public:
  double Height(double x, double y, double) const override {
    return 0.1 * std::sin(0.4 * x) + 0.05 * std::cos(0.7 * y) + (x > wall_at ? wall_height : 0.0);
  }
  double Albedo(double x, double, double) const override { return x > 0.0 ? 0.15 : 0.1; }
  bool Known(double, double, double) const override { return true; }
  Eigen::AlignedBox2d box() const override {
    return {Eigen::Vector2d(-50.0, -50.0), Eigen::Vector2d(50.0, 50.0)};
  }
  std::vector<RockShape> RockShapes() const override {
    // A pyramid of diameter 1 and height 1.
    RockShape shape;
    shape.vertices = {{0.5F, 0.5F, -0.1F},
                      {-0.5F, 0.5F, -0.1F},
                      {-0.5F, -0.5F, -0.1F},
                      {0.5F, -0.5F, -0.1F},
                      {0.0F, 0.0F, 1.0F}};
    for (const Eigen::Vector3f& vertex : shape.vertices) {
      shape.normals.push_back((vertex + Eigen::Vector3f(0.0F, 0.0F, 0.2F)).normalized());
    }
    shape.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 2, 1}, {0, 3, 2}};
    return {shape};
  }

  double wall_at = 1e9;
  double wall_height = 0.0;
};

class SceneTest : public testing::Test {
 protected:
  void Make(std::vector<Rock> rocks = {}, double spacing = 0.02) {
    MeshOptions options;
    options.spacing = spacing;
    options.reach = 100.0;
    scene_ = Scene::Create(ground_, path_, std::move(rocks), photometry_, options, &pool_);
  }
  // What lies below (x, y).
  RayPacket Down(float x, float y) const {
    RayPacket ray;
    for (int lane = 1; lane < kPacketSize; ++lane) ray.Off(lane);
    ray.Set(0, {x, y, 20.0F}, -Eigen::Vector3f::UnitZ(), 100.0F);
    scene_->Intersect(&ray);
    return ray;
  }

  ThreadPool pool_{2};
  TestSurface surface_;
  Ground ground_{surface_, Eigen::Vector3d::Zero()};
  std::vector<Eigen::Vector2d> path_ = {{0.0, 0.0}, {2.0, 0.0}, {4.0, 0.0}};
  Photometry photometry_{"moon", SunOptions{}, 0.12};
  std::unique_ptr<Scene> scene_;
};

TEST(TileTree, CoversTheGroundOnceAndFinelyAlongThePath) {
  const std::vector<Eigen::Vector2d> path = {{0.0, 0.0}, {20.0, 0.0}, {40.0, 3.0}};
  MeshOptions options;
  options.spacing = 0.005;
  options.reach = 200.0;
  const TileTree tree(options, path);
  const std::vector<TileKey> tiles = tree.Wanted({20.0, 0.0});
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector2d place(20.0 + 200.0 * std::sin(1.3 * i), 180.0 * std::sin(2.1 * i));
    int covering = 0;
    double spacing = 0.0;
    for (const TileKey& key : tiles) {
      const Eigen::Array2d offset = place - tree.Corner(key);
      if ((offset < 0.0).any() || (offset >= tree.Size(key.level)).any()) continue;
      ++covering;
      spacing = tree.Spacing(key.level);
    }
    ASSERT_EQ(covering, 1) << place.transpose();
    double distance = 1e9;
    for (const Eigen::Vector2d& point : path) distance = std::min(distance, (place - point).norm());
    const double from_rover = (place - Eigen::Vector2d(20.0, 0.0)).norm();
    if (distance < 5.0 && from_rover < 2.5) {
      EXPECT_LE(spacing, 0.005);
    }
    if (distance < 5.0 && from_rover < 7.5) {
      EXPECT_LE(spacing, 0.01);
    }
    if (distance < 20.0 && from_rover < 31.0) {
      EXPECT_LE(spacing, 0.04);
    }
  }
}

TEST_F(SceneTest, RaysMeetTheGroundWhereItIs) {
  Make();
  for (int i = 0; i < 200; ++i) {
    const auto x = static_cast<float>(30.0 * std::sin(1.7 * i));
    const auto y = static_cast<float>(30.0 * std::sin(2.9 * i));
    const RayPacket ray = Down(x, y);
    ASSERT_NE(ray.object[0], kNothing);
    const double distance = std::hypot(x, y);
    EXPECT_NEAR(20.0 - ray.distance[0], surface_.Height(x, y, 0.0), distance < 5.0 ? 1e-4 : 5e-3);
  }
}

TEST_F(SceneTest, TheSurfaceHasItsSlopeAlbedoAndLight) {
  Make();
  const RayPacket ray = Down(1.0F, 0.5F);
  const SurfacePoint point = scene_->Look(ray, 0, 0.01F, 0.01F);
  const Eigen::Vector3d normal(-0.04 * std::cos(0.4), 0.035 * std::sin(0.35), 1.0);
  EXPECT_LT((point.normal.cast<double>() - normal.normalized()).norm(), 2e-3);
  EXPECT_NEAR(point.albedo, 0.15, 1e-3);
  EXPECT_NEAR(point.light, point.normal.dot(photometry_.sun().direction), 5e-3);
}

// The wall's shadow has its edge where the sun's elevation says, and a penumbra.
TEST_F(SceneTest, ShadowsEndWhereTheSunSays) {
  surface_.wall_at = 2.0;
  surface_.wall_height = 1.0;
  SunOptions sun;
  sun.azimuth_deg = 0.0;
  sun.elevation_deg = 30.0;
  photometry_ = Photometry("moon", sun, 0.12);
  Make();
  const double edge = 2.0 - 1.0 / std::tan(30.0 * M_PI / 180.0);
  const auto light = [&](double x) {
    return scene_->Look(Down(static_cast<float>(x), 0.0F), 0, 0.01F, 0.01F).light;
  };
  EXPECT_EQ(light(edge + 0.3), 0.0F);
  EXPECT_GT(light(edge - 0.3), 0.4F);
}

TEST_F(SceneTest, ShadowsAreFilledByLitGroundAround) {
  surface_.wall_at = 2.0;
  surface_.wall_height = 1.0;
  SunOptions sun;
  sun.azimuth_deg = 180.0;  // shines on the wall
  sun.elevation_deg = 30.0;
  photometry_ = Photometry("moon", sun, 0.12);
  Make();
  const float near_wall = scene_->Look(Down(1.8F, 0.0F), 0, 0.01F, 0.01F).fill;
  const float open = scene_->Look(Down(-8.0F, 0.0F), 0, 0.01F, 0.01F).fill;
  EXPECT_GT(near_wall, 3.0F * open);
  EXPECT_LT(near_wall, 0.12F);
  MeshOptions draft;
  draft.spacing = 0.02;
  draft.reach = 100.0;
  draft.interreflection = false;
  const auto scene = Scene::Create(ground_, path_, {}, photometry_, draft, &pool_);
  RayPacket ray;
  for (int lane = 1; lane < kPacketSize; ++lane) ray.Off(lane);
  ray.Set(0, {1.8F, 0.0F, 20.0F}, -Eigen::Vector3f::UnitZ(), 100.0F);
  scene->Intersect(&ray);
  EXPECT_EQ(scene->Look(ray, 0, 0.01F, 0.01F).fill, 0.0F) << "the Moon's sky sends nothing";
}

// A rock of 10 cm is narrower than a pixel 50 m away.
TEST_F(SceneTest, RocksStandWhileTheRoverCanSeeThem) {
  for (int i = 0; i < 80; ++i) path_.emplace_back(4.0 + i, 0.0);
  Rock rock;
  rock.centre = {3.0, 1.0};
  rock.ground = surface_.Height(3.0, 1.0, 0.0);
  rock.diameter = 0.1;
  Make({rock});
  EXPECT_TRUE(scene_->IsRock(Down(3.0F, 1.0F).object[0]));
  scene_->MoveTo({80.0, 0.0});
  EXPECT_FALSE(scene_->IsRock(Down(3.0F, 1.0F).object[0]));
  scene_->MoveTo({20.0, 0.0});
  EXPECT_TRUE(scene_->IsRock(Down(3.0F, 1.0F).object[0]));
}

TEST_F(SceneTest, RocksStandOnTheGroundAndCastShadows) {
  Rock rock;
  rock.centre = {3.0, 1.0};
  rock.ground = surface_.Height(3.0, 1.0, 0.0);
  rock.diameter = 0.4;
  rock.yaw = 0.3;
  Make({rock});
  const RayPacket top = Down(3.0F, 1.0F);
  ASSERT_TRUE(scene_->IsRock(top.object[0]));
  EXPECT_NEAR(20.0 - top.distance[0], rock.ground + 0.4, 1e-3);
  const Eigen::Vector3f sun = photometry_.sun().direction;
  const Eigen::Vector2f away = -0.5F * sun.head<2>().normalized();
  EXPECT_EQ(scene_->Look(Down(3.0F + away.x(), 1.0F + away.y()), 0, 0.01F, 0.01F).light, 0.0F);
}

// Tiles of different spacing leave no gap: no ray passes between them.
TEST_F(SceneTest, HasNoHoles) {
  Make({}, 0.005);
  RayPacket rays;
  int missed = 0;
  for (int i = 0; i < 4000; ++i) {
    const float azimuth = 0.37F * static_cast<float>(i);
    const float down = 0.05F + 0.9F * std::abs(std::sin(0.91F * static_cast<float>(i)));
    for (int lane = 0; lane < kPacketSize; ++lane) {
      const float turn = azimuth + 0.02F * static_cast<float>(lane);
      rays.Set(lane, {1.0F, 0.2F, 1.2F},
               Eigen::Vector3f(std::cos(turn), std::sin(turn), -down).normalized(), 1000.0F);
    }
    scene_->Intersect(&rays);
    for (int lane = 0; lane < kPacketSize; ++lane) missed += rays.object[lane] == kNothing ? 1 : 0;
  }
  EXPECT_EQ(missed, 0);
}

TEST_F(SceneTest, MovesWithTheRover) {
  for (int i = 0; i < 40; ++i) path_.emplace_back(4.0 + i, 0.0);
  Make({}, 0.01);
  const size_t before = scene_->tile_count();
  scene_->MoveTo({40.0, 0.0});
  EXPECT_NEAR(20.0 - Down(41.0F, 0.0F).distance[0], surface_.Height(41.0, 0.0, 0.0), 1e-4);
  EXPECT_LT(scene_->tile_count(), 2 * before);
  scene_->MoveTo({0.0, 0.0});
  EXPECT_EQ(scene_->tile_count(), before);
}

TEST_F(SceneTest, TheSkyOfTheMoonIsBlackAndItsGroundIsNot) {
  Make();
  CameraOptions options;
  options.width = 160;
  options.height = 120;
  const Renderer renderer(MakeIntrinsics(options), *scene_, photometry_, &pool_);
  RenderedView view;
  renderer.Render(BaseFromCamera(options, "mono"), Surroundings{}, &view);
  int sky = 0;
  int lit = 0;
  for (size_t i = 0; i < view.radiance.size(); ++i) {
    if (std::isinf(view.distance[i])) {
      ASSERT_LE(view.radiance[i], 0.03F);  // an edge pixel may hold some ground
      sky += view.radiance[i] == 0.0F ? 1 : 0;
    } else {
      lit += view.radiance[i] > 0.005F ? 1 : 0;
    }
  }
  EXPECT_GT(sky, 160 * 20);
  EXPECT_GT(lit, 160 * 60);
}

// A camera that takes its rays' ends from its neighbour sees what it would have seen by itself,
// behind rocks and a wall too.
TEST_F(SceneTest, ANearbyViewSparesRaysAndChangesNothing) {
  surface_.wall_at = 6.0;
  surface_.wall_height = 0.5;
  std::vector<Rock> rocks;
  for (int i = 0; i < 12; ++i) {
    Rock rock;
    rock.centre = {2.0 + 0.4 * i, 1.5 * std::sin(2.3 * i)};
    rock.ground = surface_.Height(rock.centre.x(), rock.centre.y(), 0.0);
    rock.diameter = 0.1 + 0.03 * i;
    rocks.push_back(rock);
  }
  Make(rocks, 0.01);
  const CameraOptions options;
  const CameraIntrinsics intrinsics = MakeIntrinsics(options);
  const Renderer renderer(intrinsics, *scene_, photometry_, &pool_);
  RenderedView middle;
  const SE3 T_world_middle = BaseFromCamera(options, "mono");
  const SE3 T_world_right = BaseFromCamera(options, "right");
  renderer.Render(T_world_middle, Surroundings{}, &middle);
  const NearbyView nearby(middle, T_world_middle, intrinsics, 0.5 * options.baseline, *scene_);
  RenderedView spared;
  RenderedView full;
  renderer.Render(T_world_right, Surroundings{}, &spared, &nearby);
  renderer.Render(T_world_right, Surroundings{}, &full);
  int found = 0;
  int different = 0;
  for (int row = 0; row < intrinsics.height; ++row) {
    for (int column = 0; column < intrinsics.width; ++column) {
      const Eigen::Vector3f direction =
          T_world_right.rotation.cast<float>() * renderer.bearing(column, row);
      found += nearby.Find(column, row, T_world_right.translation.cast<float>(), direction) ? 1 : 0;
      const float one = spared.End(column, row).distance;
      const float other = full.End(column, row).distance;
      if (std::isinf(one) && std::isinf(other)) continue;
      different += std::abs(one - other) < 0.01F * other ? 0 : 1;
    }
  }
  const int pixels = intrinsics.width * intrinsics.height;
  EXPECT_GT(found, pixels * 7 / 10);
  EXPECT_LT(different, pixels / 1000);
}

TEST_F(SceneTest, TheRoverShadesTheGround) {
  const RoverShadow rover(RoverBody(), SE3{});
  const SunDisc& sun = photometry_.sun();
  const Eigen::Vector3f chassis(0.0F, 0.0F, 0.4F);
  const Eigen::Vector3f shaded = chassis - chassis.z() / sun.direction.z() * sun.direction;
  EXPECT_EQ(rover.Sunlit(shaded, sun), 0.0F);
  EXPECT_EQ(rover.Sunlit(-shaded, sun), 1.0F);
}

}  // namespace
}  // namespace regolith
