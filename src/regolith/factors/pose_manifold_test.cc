// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/factors/pose_manifold.h"

#include <ceres/manifold_test_utils.h>
#include <gtest/gtest.h>

#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

TEST(PoseManifold, IsAManifold) {
  using namespace ceres;  // NOLINT: the macro below names them so
  const PoseManifold manifold;
  const PoseBlock block = ToPoseBlock({ExpSo3({0.4, -0.7, 1.1}), {3.0, -2.0, 0.5}});
  Vector6d tangent;
  tangent << 0.2, -0.1, 0.3, 1.0, -2.0, 0.4;
  PoseBlock moved;
  ASSERT_TRUE(manifold.Plus(block.data(), tangent.data(), moved.data()));
  EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, block, tangent, moved, 1e-6);
}

TEST(PoseManifold, MovesAsPlusDoes) {
  const SE3 pose(ExpSo3({0.1, 0.2, -0.3}), {1.0, 2.0, 3.0});
  Vector6d tangent;
  tangent << 0.3, 0.2, -0.1, -1.0, 0.5, 0.2;
  PoseBlock moved;
  PoseManifold().Plus(ToPoseBlock(pose).data(), tangent.data(), moved.data());
  EXPECT_LT(Minus(FromPoseBlock(moved.data()), Plus(pose, tangent)).norm(), 1e-12);
}

}  // namespace
}  // namespace regolith
