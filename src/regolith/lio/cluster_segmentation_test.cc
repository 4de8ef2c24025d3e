// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/cluster_segmentation.h"

#include <gtest/gtest.h>

#include "regolith/lio/test_scene_internal.h"

namespace regolith {
namespace {

/// Share of the points within `half_size` of `centre` (m) that are labelled kCluster.
double ShareOfBox(const LidarScan& scan, const PointLabels& labels, const Eigen::Vector3d& centre,
                  const Eigen::Vector3d& half_size) {
  double inside = 0.0;
  double labelled = 0.0;
  for (size_t i = 0; i < scan.points.size(); ++i) {
    if (ToBox(scan.points[i].position.cast<double>(), centre, half_size) > 0.1) continue;
    inside += 1.0;
    labelled += labels[i] == PointLabel::kCluster ? 1.0 : 0.0;
  }
  return labelled / inside;
}

PointLabels Segment(const LidarScan& scan, const ClusterSegmentationOptions& options) {
  PointLabels labels(scan.points.size(), PointLabel::kNone);
  SegmentClusters(scan, MakeRingImage(scan, 16), options, &labels);
  return labels;
}

const Eigen::Vector3d kLarge(6, 0, 0);
const Eigen::Vector3d kLargeSize(1, 1, 1);
const Eigen::Vector3d kSmall(0, 8, 0.14);
const Eigen::Vector3d kSmallSize(0.1, 0.1, 0.1);
const Eigen::Vector3d kPole(-5, 0, 0);
const Eigen::Vector3d kPoleSize(0.08, 0.08, 2);
// Seen beside the large box, but well behind it.
const Eigen::Vector3d kBehind(16, 3.6, 0);
const Eigen::Vector3d kBehindSize(0.2, 0.2, 0.3);

double Things(const Eigen::Vector3d& point) {
  return std::min({ToBox(point, kLarge, kLargeSize), ToBox(point, kSmall, kSmallSize),
                   ToBox(point, kPole, kPoleSize), ToBox(point, kBehind, kBehindSize)});
}

TEST(ClusterSegmentation, KeepsLargeThingsAndPolesAndDropsSmallOnes) {
  TestLidar lidar;
  lidar.columns = 900;
  const LidarScan scan = CastScan(lidar, Things, 1, SE3());
  const PointLabels labels = Segment(scan, ClusterSegmentationOptions());
  EXPECT_EQ(ShareOfBox(scan, labels, kLarge, kLargeSize), 1.0);
  EXPECT_EQ(ShareOfBox(scan, labels, kPole, kPoleSize), 1.0);
  EXPECT_EQ(ShareOfBox(scan, labels, kSmall, kSmallSize), 0.0);
}

TEST(ClusterSegmentation, DoesNotJoinAcrossAStepInRange) {
  TestLidar lidar;
  lidar.columns = 900;
  const LidarScan scan = CastScan(lidar, Things, 1, SE3());
  ClusterSegmentationOptions options;
  options.min_rings = 16;
  const PointLabels labels = Segment(scan, options);
  EXPECT_EQ(ShareOfBox(scan, labels, kLarge, kLargeSize), 1.0);
  EXPECT_EQ(ShareOfBox(scan, labels, kBehind, kBehindSize), 0.0);
}

TEST(ClusterSegmentation, LeavesGroundAlone) {
  TestLidar lidar;
  const LidarScan scan = CastScan(
      lidar, [](const Eigen::Vector3d& point) { return point.z() + 1.2; }, 1, SE3());
  PointLabels labels(scan.points.size(), PointLabel::kGround);
  SegmentClusters(scan, MakeRingImage(scan, 16), ClusterSegmentationOptions(), &labels);
  for (const PointLabel label : labels) ASSERT_EQ(label, PointLabel::kGround);
}

}  // namespace
}  // namespace regolith
