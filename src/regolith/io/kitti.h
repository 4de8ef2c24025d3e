// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "regolith/io/recording.h"

namespace regolith {

/// KITTI's two layouts. Scans are x y z intensity without firing times or rings: rings are told
/// from the order of the points (the files hold one ring after the other from the top, each turning
/// counter-clockwise from the front), times are absent. Stamps count from the first scan. The body
/// is the lidar.

/// A drive of the raw set: velodyne_points/, image_00/, …, calibration in the folder above.
bool IsKittiRaw(const std::string& folder);
/// A sequence of the odometry set: velodyne/, times.txt, calib.txt, image_0/, ….
bool IsKittiOdometry(const std::string& folder);
/// The drives (…_sync) in a folder of one date.
std::vector<std::string> KittiDrives(const std::string& folder);

void ApplyKittiCalibration(const RecordingIdentity& identity, RigCalibration* rig);

std::unique_ptr<SensorSource> OpenKitti(const RecordingIdentity& identity,
                                        const RigCalibration& rig, const ReadOptions& options);

/// Points of a .bin file with rings 0 (lowest) to rings - 1, told from where the azimuth starts
/// anew; points that are not finite are left out and counted. Throws InputError for a file that
/// cannot be read or whose length is not a multiple of 16.
LidarScan ReadKittiScan(const std::string& path, int rings, size_t* invalid_points);

}  // namespace regolith
