// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "regolith/ros/ros_parameters_internal.h"

namespace regolith {
namespace {

using XmlRpc::XmlRpcValue;

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    if (letter == '\n') {
      quoted += "\\n";
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

std::string Number(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

std::string Join(const std::string& left, const std::string& more) {
  return left.empty() ? more : left + ", " + more;
}

}  // namespace

std::string YamlOfParameter(XmlRpcValue value) {
  std::string inside;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int>(value));
    case XmlRpcValue::TypeDouble:
      return Number(static_cast<double>(value));
    case XmlRpcValue::TypeString:
      return Quoted(static_cast<std::string>(value));
    case XmlRpcValue::TypeArray:
      for (int i = 0; i < value.size(); ++i) inside = Join(inside, YamlOfParameter(value[i]));
      return "[" + inside + "]";
    case XmlRpcValue::TypeStruct:
      for (auto& [key, item] : value) {
        inside = Join(inside, Quoted(key) + ": " + YamlOfParameter(item));
      }
      return "{" + inside + "}";
    default:
      return "null";
  }
}

NodeParameters ReadParameters(const ros::NodeHandle& private_node) {
  XmlRpcValue all;
  NodeParameters parameters;
  if (!private_node.getParam(private_node.getNamespace(), all) ||
      all.getType() != XmlRpcValue::TypeStruct) {
    parameters.options = "{}";
    return parameters;
  }
  std::string options;
  for (auto& [key, value] : all) {
    if (key == "settings") {
      parameters.settings = YamlOfParameter(value);
    } else if (key != "map_file" && key != "trajectory_file") {
      // Those two are read when they are needed.
      options = Join(options, Quoted(key) + ": " + YamlOfParameter(value));
    }
  }
  parameters.options = "{" + options + "}";
  return parameters;
}

std::string TextParameter(const ros::NodeHandle& private_node, const std::string& name,
                          const std::string& fallback) {
  std::string text;
  return private_node.getParam(name, text) && !text.empty() ? text : fallback;
}

}  // namespace regolith
