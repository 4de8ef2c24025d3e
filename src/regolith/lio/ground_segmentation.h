// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/lio/ground_segmentation_options.h"
#include "regolith/lio/point_labels.h"
#include "regolith/lio/ring_image.h"
#include "regolith/sensor/lidar_scan.h"

namespace regolith {

/// Labels the ground of a scan kGround and leaves the rest kNone. Shan & Englot 2018 call ground
/// what lies level between one ring and the next (within 10°, after Himmelsbach et al. 2010), which
/// a crater's wall or a dune does not. Here only its beginning must lie roughly level, at the
/// lowest beam of a column; from there it grows to neighbours as long as the slope from ring to
/// ring bends little. `up_lidar`: the rover's own up, unit, in the lidar's frame.
PointLabels SegmentGround(const LidarScan& scan, const RingImage& image,
                          const Eigen::Vector3d& up_lidar,
                          const GroundSegmentationOptions& options);

}  // namespace regolith
