// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regolith/core/thread_pool.h"
#include "regolith/io/message_decoder.h"
#include "regolith/ros/slam_node_options.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/system/slam_system.h"

namespace regolith {

/// What a SLAM node is made of, resolved and checked before it listens.
struct NodeSetup {
  SlamNodeOptions options;
  RigCalibration rig;
  PipelineOptions pipeline;
  std::optional<Image> camera_mask;
  SE3 T_imu_base;
  std::vector<SensorTopic> topics;  ///< that the pipeline reads, in the order of equal stamps
};

/// Resolves the parameters of the node `name`, given as YAML: those of SlamNodeOptions, and
/// `settings`, laid over the pipeline's. Throws InputError that names what is wrong.
NodeSetup ResolveNodeSetup(const std::string& name, const std::string& parameters,
                           const std::string& settings);

/// A pipeline as the setup says.
std::unique_ptr<SlamSystem> MakeSlamSystem(const NodeSetup& setup, ThreadPool* threads);

}  // namespace regolith
