// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "regolith/io/recording.h"

namespace regolith {

/// A recording in the layout of EuRoC (ETH's ASL): imu0/data.csv, cam0 ("left") and cam1 ("right")
/// with data.csv and data/*.png, each with a sensor.yaml. `folder` is mav0.

bool IsEuroc(const std::string& folder);

/// Noise and rate of the IMU, intrinsics and poses of the cameras, as sensor.yaml gives them.
/// Cameras that are not in the folder leave the rig. Throws InputError for a sensor.yaml that
/// cannot be understood.
void ApplyEurocCalibration(const std::string& folder, RigCalibration* rig);

std::unique_ptr<SensorSource> OpenEuroc(const std::string& folder, const RigCalibration& rig,
                                        const ReadOptions& options);

}  // namespace regolith
