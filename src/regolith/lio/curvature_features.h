// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/lio/curvature_features_options.h"
#include "regolith/lio/point_labels.h"
#include "regolith/lio/ring_image.h"
#include "regolith/sensor/lidar_scan.h"

namespace regolith {

/// Edge and planar points of a scan as indices into its points, each list ring by ring.
struct CurvatureFeatures {
  std::vector<uint32_t> sharp_edges;   ///< the most curved of each ring and sector
  std::vector<uint32_t> edges;         ///< more of them, the sharp ones among them
  std::vector<uint32_t> flat_planars;  ///< the least curved of each ring and sector
  std::vector<uint32_t> planars;       ///< all of low curvature
};

/// Edge and planar points by their curvature along the ring (Zhang & Singh 2014, section V-A; Shan
/// & Englot 2018, eq. 1, by which range stands for position). Points behind an occlusion's boundary
/// and points of grazing beams are neither. Where there are `labels`, edges are of clusters, flat
/// planars of the ground, and planars of either (Shan & Englot 2018, section III-C); with none any
/// point may be any of them.
CurvatureFeatures ExtractCurvatureFeatures(const RingImage& image, const PointLabels* labels,
                                           const CurvatureFeatureOptions& options);

/// The same of all points of a scan of up to `rings` rings.
CurvatureFeatures ExtractCurvatureFeatures(const LidarScan& scan, int rings,
                                           const CurvatureFeatureOptions& options);

}  // namespace regolith
