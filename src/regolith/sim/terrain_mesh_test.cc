// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/terrain_mesh.h"

#include <cmath>

#include <gtest/gtest.h>

#include "regolith/core/random.h"
#include "regolith/sim/mesh_tiles.h"
#include "regolith/sim/row_caster.h"

namespace regolith {
namespace {

const Eigen::AlignedBox2d kBox(Eigen::Vector2d(-40, -40), Eigen::Vector2d(40, 40));

class TerrainMeshTest : public testing::Test {
 protected:
  TerrainMeshTest()
      : surface_(CreateGeneratedSurface(TerrainOptions{}, 3, kBox)),
        ground_(*surface_, Eigen::Vector3d(1.0, 2.0, 0.1)),
        pool_(2) {
    options_.spacing = 0.04;
    options_.reach = 60.0;
    sun_.direction = Eigen::Vector3f(1.0F, 0.0F, 0.21F).normalized();
    mesh_ = TerrainMesh::Create(ground_, path_, sun_, options_, &pool_);
  }

  float Distance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
    RayPacket rays;
    for (int lane = 0; lane < kPacketSize; ++lane) {
      rays.Set(lane, origin, direction, lane == 0 ? 500.0F : -1.0F);
    }
    mesh_->Intersect(&rays, false);
    return rays.distance[0];
  }

  std::unique_ptr<Surface> surface_;
  Ground ground_;
  ThreadPool pool_;
  MeshOptions options_;
  SunDisc sun_;
  std::vector<Eigen::Vector2d> path_ = {Eigen::Vector2d(0, 0), Eigen::Vector2d(4, 0)};
  std::unique_ptr<TerrainMesh> mesh_;
};

TEST_F(TerrainMeshTest, LiesOnTheGroundNearThePath) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const double x = random.Uniform(-4.0, 8.0);
    const double y = random.Uniform(-4.0, 4.0);
    const float z =
        50.0F - Distance(Eigen::Vector3d(x, y, 50.0).cast<float>(), -Eigen::Vector3f::UnitZ());
    EXPECT_NEAR(z, ground_.Height(x, y, 0.04), 0.006);
  }
}

TEST_F(TerrainMeshTest, HasNoHolesAcrossItsLevels) {
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const double angle = random.Uniform(0.0, 2.0 * M_PI);
    const double place = random.Uniform(0.0, 42.0);
    const Eigen::Vector3d origin(place * std::cos(angle), place * std::sin(angle), 30.0);
    const Eigen::Vector3d aim(0.1 * random.Gaussian(), 0.1 * random.Gaussian(), -1.0);
    EXPECT_TRUE(std::isfinite(Distance(origin.cast<float>(), aim.normalized().cast<float>())));
  }
}

TEST_F(TerrainMeshTest, NeighboursShareTheirEdges) {
  const MeshTiles tiles = BuildMeshTiles(ground_, path_, options_, &pool_);
  for (int row = 0; row < tiles.rows; ++row) {
    for (int column = 0; column + 1 < tiles.columns; ++column) {
      const MeshTile& west = tiles.TileAt(column, row);
      const MeshTile& east = tiles.TileAt(column + 1, row);
      const int posts = std::min(west.posts, east.posts);
      for (int knot = 0; knot < posts; ++knot) {
        const auto at = [&](const MeshTile& tile, int edge_column) {
          const int line = knot * (tile.posts - 1) / (posts - 1);
          return tiles
              .positions[tile.first_post + static_cast<size_t>(line * tile.posts + edge_column)];
        };
        EXPECT_NEAR(at(west, west.posts - 1).z(), at(east, 0).z(), 1e-5F);
      }
    }
  }
}

TEST_F(TerrainMeshTest, PartOfTheGroundLiesInShadowUnderALowSun) {
  int shaded = 0;
  int lit = 0;
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const GroundPoint point = mesh_->At(static_cast<float>(random.Uniform(-4.0, 8.0)),
                                        static_cast<float>(random.Uniform(-4.0, 4.0)));
    EXPECT_NEAR(point.normal.norm(), 1.0F, 1e-5F);
    (point.sunlit < 0.5F ? shaded : lit) += 1;
  }
  EXPECT_GT(shaded, 100);
  EXPECT_GT(lit, 1000);
}

TEST_F(TerrainMeshTest, InterpolatedRaysAgreeWithCastOnes) {
  const Eigen::Vector3f origin(0.0F, 0.0F, static_cast<float>(ground_.Height(0, 0, 0.04) + 1.1));
  const RowCaster caster(*mesh_, origin);
  int wrong = 0;
  int rays = 0;
  for (const float down : {0.2F, 0.4F, 0.7F}) {
    RayRow row;
    for (int i = 0; i < 640; ++i) {
      row.directions.push_back(
          Eigen::Vector3f(1.0F, 0.0025F * static_cast<float>(i - 320), -down).normalized());
    }
    caster.CastSparse(&row);
    for (size_t i = 1; i < row.directions.size(); i += 2) {
      const float exact = Distance(origin, row.directions[i]);
      ++rays;
      if (std::abs(row.distances[i] - exact) > 0.02F * exact) ++wrong;
    }
  }
  EXPECT_LT(wrong, rays / 50);
}

}  // namespace
}  // namespace regolith
