// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/two_step_matcher.h"

#include <gtest/gtest.h>

#include "regolith/geometry/so3.h"
#include "regolith/lio/test_scene_internal.h"

namespace regolith {
namespace {

const SE3 kFirst(Eigen::Quaterniond::Identity(), {0, 0, 1.5});
const SE3 kMotion(ExpSo3({0.01, -0.015, 0.03}), {0.25, 0.05, 0.02});

ScanFeatures FeaturesAt(const SE3& T_world_lidar, uint64_t seed) {
  TestLidar lidar;
  lidar.columns = 900;
  const LidarScan scan = CastScan(lidar, TestYard, seed, T_world_lidar);
  std::vector<Eigen::Vector3d> points;
  for (const LidarPoint& point : scan.points) points.push_back(point.position.cast<double>());
  return PlaceFeatures(SegmentScan(scan, 16, Eigen::Vector3d::UnitZ(), SegmentationOptions()),
                       points, 0.2);
}

TwoStepMatch Match(const ScanFeatures& current) {
  ThreadPool threads(2);
  const FeatureTarget target(FeaturesAt(kFirst, 1));
  return MatchTwoStep(current, target, SE3(), Eigen::Vector3d::UnitZ(), TwoStepMatcherOptions(),
                      &threads);
}

TEST(TwoStepMatcher, FindsTheMotionBetweenTwoScans) {
  const TwoStepMatch match = Match(FeaturesAt(kFirst * kMotion, 2));
  EXPECT_TRUE(match.used_ground);
  EXPECT_TRUE(match.used_edges);
  const Vector6d error = Minus(match.T_last_current, kMotion);
  EXPECT_LT(error.head<3>().norm(), 0.01);
  EXPECT_LT(error.tail<3>().norm(), 0.05);
}

TEST(TwoStepMatcher, GroundAloneGivesHeightRollAndPitch) {
  ScanFeatures current = FeaturesAt(kFirst * kMotion, 2);
  current.sharp_edges.clear();
  current.cluster_planars.clear();
  const TwoStepMatch match = Match(current);
  EXPECT_TRUE(match.used_ground);
  EXPECT_FALSE(match.used_edges);
  EXPECT_NEAR(match.T_last_current.translation.z(), kMotion.translation.z(), 0.03);
  EXPECT_NEAR(match.T_last_current.translation.head<2>().norm(), 0.0, 1e-6);
  const Eigen::Vector3d rotation = LogSo3(match.T_last_current.rotation);
  EXPECT_LT((rotation.head<2>() - LogSo3(kMotion.rotation).head<2>()).norm(), 0.01);
  EXPECT_NEAR(rotation.z(), 0.0, 1e-3);
}

TEST(TwoStepMatcher, WithoutFeaturesTheGuessStays) {
  const TwoStepMatch match = Match(ScanFeatures());
  EXPECT_FALSE(match.used_ground);
  EXPECT_FALSE(match.used_edges);
  EXPECT_EQ(match.T_last_current.translation, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace regolith
