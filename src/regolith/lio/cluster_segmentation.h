// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/lio/cluster_segmentation_options.h"
#include "regolith/lio/point_labels.h"
#include "regolith/lio/ring_image.h"
#include "regolith/sensor/lidar_scan.h"

namespace regolith {

/// Labels kCluster the points off the ground that make connected things of some size (Shan & Englot
/// 2018, section III-B, by the criterion of Bogoslavskyi & Stachniss 2016). Points labelled kGround
/// are left alone. The angle between two beams is taken from the points themselves, so rings may be
/// spaced as they like.
void SegmentClusters(const LidarScan& scan, const RingImage& image,
                     const ClusterSegmentationOptions& options, PointLabels* labels);

}  // namespace regolith
