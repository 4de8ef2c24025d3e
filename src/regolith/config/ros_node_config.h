// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/config/fields.h"
#include "regolith/ros/sim_node_options.h"
#include "regolith/ros/slam_node_options.h"

namespace regolith {

/// The parameters of a ROS node as a document says them, checked. Throws InputError that names the
/// parameter.
SlamNodeOptions LoadSlamNode(const YamlDocument& document);
SimNodeOptions LoadSimNode(const YamlDocument& document);

/// Likewise as YAML, which reads back.
std::string WriteSlamNode(const SlamNodeOptions& options);
std::string WriteSimNode(const SimNodeOptions& options);

}  // namespace regolith
