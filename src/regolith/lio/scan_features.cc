// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/scan_features.h"

#include "regolith/cloud/downsample.h"
#include "regolith/core/check.h"
#include "regolith/lio/cluster_segmentation.h"
#include "regolith/lio/ground_segmentation.h"
#include "regolith/lio/ring_image.h"

namespace regolith {
namespace {

std::vector<int> RowsOfPoints(const RingImage& image, size_t count) {
  std::vector<int> rows(count, -1);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const int32_t index = image.Index(row, column);
      if (index != RingImage::kEmpty) rows[static_cast<size_t>(index)] = row;
    }
  }
  return rows;
}

std::vector<RingPoint> Place(Span<const uint32_t> indices, Span<const int> rows,
                             Span<const Eigen::Vector3d> points_lidar) {
  std::vector<RingPoint> placed;
  placed.reserve(indices.size());
  for (const uint32_t index : indices) placed.push_back({points_lidar[index], rows[index]});
  return placed;
}

}  // namespace

void SegmentationOptions::Check() const {
  ground.Check();
  clusters.Check();
  features.Check();
}

SegmentedScan SegmentScan(const LidarScan& scan, int rings, const Eigen::Vector3d& up_lidar,
                          const SegmentationOptions& options) {
  const RingImage image = MakeRingImage(scan, rings);
  SegmentedScan segmented;
  segmented.labels = SegmentGround(scan, image, up_lidar, options.ground);
  SegmentClusters(scan, image, options.clusters, &segmented.labels);
  segmented.features = ExtractCurvatureFeatures(image, &segmented.labels, options.features);
  segmented.rows = RowsOfPoints(image, scan.points.size());
  segmented.rings_reordered = image.rings_reordered;
  segmented.invalid_points = image.invalid_points;
  return segmented;
}

ScanFeatures PlaceFeatures(const SegmentedScan& segmented, Span<const Eigen::Vector3d> points_lidar,
                           double voxel_size) {
  REGOLITH_CHECK(points_lidar.size() == segmented.rows.size(), points_lidar.size(), " points for ",
                 segmented.rows.size(), " rows");
  const CurvatureFeatures& features = segmented.features;
  ScanFeatures placed;
  placed.sharp_edges = Place(features.sharp_edges, segmented.rows, points_lidar);
  placed.edges = Place(features.edges, segmented.rows, points_lidar);
  placed.flat_planars = Place(features.flat_planars, segmented.rows, points_lidar);
  std::vector<Eigen::Vector3d> planars;
  for (const uint32_t index : features.planars) planars.push_back(points_lidar[index]);
  for (const uint32_t kept : DownsampleIndices(planars, voxel_size)) {
    const uint32_t index = features.planars[kept];
    auto& list = segmented.labels[index] == PointLabel::kGround ? placed.ground_planars
                                                                : placed.cluster_planars;
    list.push_back({points_lidar[index], segmented.rows[index]});
  }
  return placed;
}

}  // namespace regolith
