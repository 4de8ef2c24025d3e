// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/rock_shapes.h"

#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace regolith {
namespace {

Eigen::AlignedBox3f Extent(const RockShape& shape) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : shape.vertices) box.extend(vertex);
  return box;
}

TEST(RockShapes, AreClosed) {
  for (const RockShape& shape : MakeRockShapes(0.5)) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (const auto& triangle : shape.triangles) {
      for (size_t i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
    EXPECT_EQ(shape.vertices.size(), 642U);
  }
}

TEST(RockShapes, HaveTheExtentHeightAndBurialAskedFor) {
  for (const double share : {0.5, 0.4}) {
    double mean = 0.0;
    for (const RockShape& shape : MakeRockShapes(share)) {
      const Eigen::AlignedBox3f box = Extent(shape);
      EXPECT_NEAR(box.sizes().head<2>().mean(), 1.0, 1e-5);
      mean += static_cast<double>(box.max().z()) / kRockShapes;
      const double sunk = static_cast<double>(-box.min().z() / box.sizes().z());
      EXPECT_GE(sunk, 0.2);
      EXPECT_LE(sunk, 0.5);
    }
    EXPECT_NEAR(mean, share, 0.06 * share);
  }
}

TEST(RockShapes, HaveUnitNormalsThatLookOut) {
  for (const RockShape& shape : MakeRockShapes(0.5)) {
    const Eigen::Vector3f centre = Extent(shape).center();
    int outward = 0;
    for (size_t i = 0; i < shape.vertices.size(); ++i) {
      EXPECT_NEAR(shape.normals[i].norm(), 1.0F, 1e-4F);
      if (shape.normals[i].dot(shape.vertices[i] - centre) > 0.0F) ++outward;
    }
    EXPECT_GT(outward, 630);
  }
}

TEST(RockTops, FollowTheMesh) {
  const std::vector<RockShape> shapes = MakeRockShapes(0.5);
  const RockTops tops(shapes);
  Rock rock;
  rock.centre = {3.0, -2.0};
  rock.ground = 0.7;
  rock.diameter = 0.4;
  rock.yaw = 1.1;
  int close = 0;
  int apart = 0;
  for (rock.shape = 0; rock.shape < kRockShapes; ++rock.shape) {
    const RockShape& shape = shapes[rock.shape];
    for (size_t i = 0; i < shape.vertices.size(); ++i) {
      if (shape.normals[i].z() < 0.7F) continue;
      const Eigen::Vector2d place =
          rock.centre + Eigen::Rotation2Dd(rock.yaw) *
                            (rock.diameter * shape.vertices[i].head<2>().cast<double>());
      const double top = rock.ground + rock.diameter * static_cast<double>(shape.vertices[i].z());
      ++(std::abs(tops.Top(rock, place.x(), place.y()) - top) < 0.012 ? close : apart);
    }
    EXPECT_TRUE(std::isinf(tops.Top(rock, 3.4, -2.0)));
  }
  EXPECT_LT(apart, 0.005 * close);  // vertices at a steep edge
}

}  // namespace
}  // namespace regolith
