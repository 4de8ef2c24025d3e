// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Not one of the exported headers: it names ROS types, and is for .cc files only.
#include <string>

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

namespace regolith {

/// A parameter as a YAML flow value: {a: 1, b: [2, 3]}.
std::string YamlOfParameter(XmlRpc::XmlRpcValue value);

/// The node's own parameters.
struct NodeParameters {
  std::string options;   ///< YAML of all but `settings`
  std::string settings;  ///< YAML of those; empty where there are none
};
NodeParameters ReadParameters(const ros::NodeHandle& private_node);

/// A text parameter of that name, such as a path that a service is to write to.
std::string TextParameter(const ros::NodeHandle& private_node, const std::string& name,
                          const std::string& fallback);

}  // namespace regolith
