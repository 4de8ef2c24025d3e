// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/keyframe_store.h"

#include <gtest/gtest.h>

namespace regolith {
namespace {

/// Three keyframes a metre apart, each of which saw one point above itself; `step_sigma`: m, of the
/// way from the second to the third.
size_t PointsAroundTheThird(double step_sigma) {
  KeyframeStore store({}, ReliefMatchOptions{});
  FactorGraph graph((FactorGraphOptions()));
  OdometryChain odometry;
  const std::vector<Eigen::Vector3d> above = {{0.0, 0.0, 2.0}};
  for (int i = 0; i < 3; ++i) {
    const SE3 pose(Eigen::Quaterniond::Identity(), {static_cast<double>(i), 0.0, 0.0});
    const double sigma = i == 2 ? step_sigma : 0.01;
    graph.AddNode(pose);
    odometry.Append(pose, sigma * sigma * Matrix6d::Identity());
    store.Append(FromSeconds(i), i, above);
  }
  return store.Submap(2, 0, 3, graph, odometry).size();
}

TEST(KeyframeStore, ASubmapEndsWhereOdometryWasBlind) {
  EXPECT_EQ(PointsAroundTheThird(0.02), 3U);
  EXPECT_EQ(PointsAroundTheThird(2.0), 1U);
}

}  // namespace
}  // namespace regolith
