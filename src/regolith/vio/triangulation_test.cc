// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

const Eigen::Vector3d kPoint(0.7, -0.4, 5.0);

/// A camera at `position` that sees `point`, whichever way it is turned.
PointView See(const Eigen::Vector3d& position, const Eigen::Vector3d& point) {
  PointView view;
  view.T_world_camera = SE3(ExpSo3(0.1 * position), position);
  view.bearing = (view.T_world_camera.Inverse() * point).normalized();
  return view;
}

TEST(Triangulate, FindsThePointAndItsParallax) {
  const auto point =
      Triangulate({See({0, 0, 0}, kPoint), See({0.5, 0, 0}, kPoint), See({0.2, -0.3, 1}, kPoint)});
  ASSERT_TRUE(point.has_value());
  EXPECT_LT((point->point_world - kPoint).norm(), 1e-9);
  const Eigen::Vector3d second = kPoint - Eigen::Vector3d(0.5, 0.0, 0.0);
  const double angle = std::acos(kPoint.normalized().dot(second.normalized()));
  EXPECT_NEAR(point->parallax, angle, 1e-9);
}

TEST(Triangulate, AFarSecondViewCountsAsMuchAsItsBearingTells) {
  // One camera near, one three times as far off, bearings 1 mrad wrong: the error is about
  // 1 mrad · distance / parallax.
  Random random(7);
  double squares = 0.0;
  constexpr int kTrials = 200;
  for (int i = 0; i < kTrials; ++i) {
    std::vector<PointView> views = {See({0, 0, 0}, kPoint), See({1, 0, 0}, kPoint),
                                    See({3, 1, -10}, kPoint)};
    for (PointView& view : views) {
      const Eigen::Vector3d error(random.Gaussian(), random.Gaussian(), random.Gaussian());
      view.bearing = (view.bearing + 1e-3 * error).normalized();
    }
    const auto point = Triangulate(views);
    ASSERT_TRUE(point.has_value());
    squares += (point->point_world - kPoint).squaredNorm();
  }
  const double expected = 1e-3 * kPoint.norm() / 0.2;
  EXPECT_LT(std::sqrt(squares / kTrials), 2.0 * expected);
}

TEST(Triangulate, NothingFromParallelRays) {
  PointView first;
  PointView second;
  second.T_world_camera.translation = {1.0, 0.0, 0.0};
  EXPECT_FALSE(Triangulate({first, second}).has_value());
  EXPECT_FALSE(Triangulate({first}).has_value());
}

TEST(Triangulate, NothingBehindACamera) {
  // The rays part in front of the cameras: their lines meet behind.
  PointView first;
  PointView second;
  second.T_world_camera.translation = {1.0, 0.0, 0.0};
  second.bearing = Eigen::Vector3d(0.2, 0.0, 1.0).normalized();
  EXPECT_FALSE(Triangulate({first, second}).has_value());
}

}  // namespace
}  // namespace regolith
