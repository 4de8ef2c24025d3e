// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/keyframe_graph.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

/// Features of a field that is 60 m wide, other in each place: mounds, walls and posts.
FeatureCloud Field() {
  Random random(8);
  FeatureCloud cloud;
  for (double x = -30.0; x < 30.0; x += 0.5) {
    for (double y = -30.0; y < 30.0; y += 0.5) {
      cloud.planars.emplace_back(x, y, 0.4 * std::sin(0.5 * x) * std::cos(0.4 * y));
    }
  }
  for (int i = 0; i < 60; ++i) {
    const double x = random.Uniform(-30, 30);
    const double y = random.Uniform(-30, 30);
    for (double z = 0.0; z < 2.0; z += 0.25) cloud.edges.emplace_back(x, y, z);
  }
  return cloud;
}

FeatureCloud Seen(const FeatureCloud& field, const SE3& T_world_lidar) {
  const SE3 T_lidar_world = T_world_lidar.Inverse();
  FeatureCloud seen;
  const auto keep = [&](const std::vector<Eigen::Vector3d>& all,
                        std::vector<Eigen::Vector3d>* kept) {
    for (const Eigen::Vector3d& point : all) {
      if ((point - T_world_lidar.translation).norm() < 8.0) kept->push_back(T_lidar_world * point);
    }
  };
  keep(field.edges, &seen.edges);
  keep(field.planars, &seen.planars);
  return seen;
}

SE3 Truth(int i) {
  const double angle = 2.0 * 3.14159265358979 * i / 100.0;
  return {ExpSo3({0.0, 0.0, angle}), {12.0 * std::sin(angle), 12.0 * (1.0 - std::cos(angle)), 1.0}};
}

TEST(KeyframeGraph, ALoopTakesTheDriftAway) {
  ThreadPool threads(2);
  const FeatureCloud field = Field();
  KeyframeGraphOptions options;
  KeyframeGraph graph(options, FeatureMapOptions());
  SE3 drifting = Truth(0);
  for (int i = 0; i <= 104; ++i) {
    if (i > 0) {
      SE3 step = Truth(i - 1).Inverse() * Truth(i);
      step.rotation = step.rotation * ExpSo3({0.0, 0.0, 0.0006});
      step.translation.x() *= 1.005;
      drifting = drifting * step;
    }
    EXPECT_TRUE(graph.IsNew(drifting));
    graph.Add({FromSeconds(2.0 * i), drifting, Seen(field, Truth(i))});
    if (graph.CloseLoop(&threads)) drifting = graph.keyframes().back().T_map_lidar;
  }
  EXPECT_GT(graph.loops_accepted(), 0U);
  // Driven without loops the last pose would be off by 0.4 m.
  EXPECT_LT((graph.keyframes().back().T_map_lidar.translation - Truth(104).translation).norm(),
            0.1);
}

TEST(KeyframeGraph, AnotherPlaceMakesNoLoop) {
  ThreadPool threads(2);
  const FeatureCloud field = Field();
  KeyframeGraph graph{KeyframeGraphOptions(), FeatureMapOptions()};
  // The poses say that the rover came back, the features that it did not.
  for (int i = 0; i < 8; ++i) {
    const SE3 claimed(Eigen::Quaterniond::Identity(), {0.5 * i, 0, 1});
    graph.Add({FromSeconds(i), claimed, Seen(field, claimed)});
  }
  for (int i = 0; i < 6; ++i) {
    const SE3 claimed(Eigen::Quaterniond::Identity(), {0.5 * i, 0.5, 1});
    const SE3 real(ExpSo3({0.0, 0.0, 2.0}), {-15.0 + 0.5 * i, 14.0, 1});
    graph.Add({FromSeconds(100 + i), claimed, Seen(field, real)});
    EXPECT_FALSE(graph.CloseLoop(&threads));
  }
  EXPECT_EQ(graph.loops_accepted(), 0U);
  EXPECT_GT(graph.loops_rejected(), 0U);
}

TEST(KeyframeGraph, IsNewByWayOrTurn) {
  KeyframeGraph graph{KeyframeGraphOptions(), FeatureMapOptions()};
  EXPECT_TRUE(graph.IsNew(SE3()));
  graph.Add({0, SE3(), FeatureCloud()});
  EXPECT_FALSE(graph.IsNew({ExpSo3({0.0, 0.0, 0.1}), {0.2, 0.0, 0.0}}));
  EXPECT_TRUE(graph.IsNew({Eigen::Quaterniond::Identity(), {0.4, 0.0, 0.0}}));
  EXPECT_TRUE(graph.IsNew({ExpSo3({0.0, 0.0, 0.3}), Eigen::Vector3d::Zero()}));
}

}  // namespace
}  // namespace regolith
