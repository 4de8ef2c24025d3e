// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/curvature_features.h"

#include <gtest/gtest.h>

#include "regolith/lio/test_scene_internal.h"

namespace regolith {
namespace {

double Room(const Eigen::Vector3d& point) {
  return std::min(6.0 - std::abs(point.x()), 5.0 - std::abs(point.y()));
}

double RoomWithPole(const Eigen::Vector3d& point) {
  return std::min(Room(point), std::hypot(point.x() - 3.0, point.y() - 0.5) - 0.15);
}

LidarScan Scan(const TestScene& scene) {
  TestLidar lidar;
  lidar.columns = 900;
  lidar.sigma = 0.005;
  return CastScan(lidar, scene, 2, SE3());
}

TEST(CurvatureFeatures, EdgesOfARoomAreItsCorners) {
  const LidarScan scan = Scan(Room);
  const CurvatureFeatures features = ExtractCurvatureFeatures(scan, 16, CurvatureFeatureOptions());
  // Each ring sees four corners.
  EXPECT_GE(features.sharp_edges.size(), 16U * 4U);
  EXPECT_LE(features.sharp_edges.size(), features.edges.size());
  for (const uint32_t index : features.sharp_edges) {
    const Eigen::Vector3f& point = scan.points[index].position;
    EXPECT_LT(std::hypot(6.0F - std::abs(point.x()), 5.0F - std::abs(point.y())), 0.3F);
  }
}

TEST(CurvatureFeatures, PlanarsOfARoomAreItsWallsAllAround) {
  const LidarScan scan = Scan(Room);
  const CurvatureFeatureOptions options;
  const CurvatureFeatures features = ExtractCurvatureFeatures(scan, 16, options);
  EXPECT_EQ(features.flat_planars.size(),
            static_cast<size_t>(16 * options.sectors * options.flat_planars));
  EXPECT_GT(features.planars.size(), scan.points.size() / 2);
  for (const uint32_t index : features.flat_planars) {
    const Eigen::Vector3f& point = scan.points[index].position;
    EXPECT_GT(std::hypot(6.0F - std::abs(point.x()), 5.0F - std::abs(point.y())), 0.1F);
  }
}

TEST(CurvatureFeatures, WhatAThingHidesInPartIsNoEdge) {
  const LidarScan scan = Scan(RoomWithPole);
  const CurvatureFeatures features = ExtractCurvatureFeatures(scan, 16, CurvatureFeatureOptions());
  int of_pole = 0;
  for (const uint32_t index : features.edges) {
    const Eigen::Vector3f& point = scan.points[index].position;
    const bool is_corner =
        std::hypot(6.0F - std::abs(point.x()), 5.0F - std::abs(point.y())) < 0.5F;
    const bool is_pole = std::hypot(point.x() - 3.0F, point.y() - 0.5F) < 0.3F;
    of_pole += is_pole ? 1 : 0;
    // The wall on both sides of the pole ends where the pole begins: not an edge of the wall.
    EXPECT_TRUE(is_corner || is_pole) << point.transpose();
  }
  EXPECT_GT(of_pole, 8);
}

TEST(CurvatureFeatures, NoFeaturesWhereBeamsGraze) {
  // A wall that the lidar almost stands in: beams along it are spread over metres.
  const LidarScan scan =
      Scan([](const Eigen::Vector3d& point) { return std::min(0.15 - point.y(), 60.0); });
  const CurvatureFeatures features = ExtractCurvatureFeatures(scan, 16, CurvatureFeatureOptions());
  for (const auto* list : {&features.edges, &features.planars}) {
    for (const uint32_t index : *list) EXPECT_LT(scan.points[index].position.norm(), 3.5F);
  }
}

TEST(CurvatureFeatures, LabelsSayWhatMayBeWhat) {
  const LidarScan scan = Scan(RoomWithPole);
  const RingImage image = MakeRingImage(scan, 16);
  PointLabels labels(scan.points.size());
  for (size_t i = 0; i < labels.size(); ++i) {
    const float x = scan.points[i].position.x();
    labels[i] = x > 1.0F    ? PointLabel::kCluster
                : x < -1.0F ? PointLabel::kGround
                            : PointLabel::kNone;
  }
  const CurvatureFeatures features =
      ExtractCurvatureFeatures(image, &labels, CurvatureFeatureOptions());
  EXPECT_FALSE(features.edges.empty());
  EXPECT_FALSE(features.flat_planars.empty());
  for (const uint32_t index : features.edges) EXPECT_EQ(labels[index], PointLabel::kCluster);
  for (const uint32_t index : features.flat_planars) EXPECT_EQ(labels[index], PointLabel::kGround);
  for (const uint32_t index : features.planars) EXPECT_NE(labels[index], PointLabel::kNone);
}

TEST(CurvatureFeatures, OfAFewPointsAreNone) {
  LidarScan scan = Scan(Room);
  scan.points.resize(50);
  const CurvatureFeatures features = ExtractCurvatureFeatures(scan, 16, CurvatureFeatureOptions());
  EXPECT_TRUE(features.edges.empty());
  EXPECT_TRUE(features.planars.empty());
}

}  // namespace
}  // namespace regolith
