// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/ros_node_config.h"

namespace regolith {

template <typename Archive>
void Fields(Archive& archive, EventMergerOptions& merger) {
  archive("hold", merger.hold);
  archive("silence", merger.silence);
  archive("max_ahead", merger.max_ahead);
  archive("max_behind", merger.max_behind);
  archive("jump_evidence", merger.jump_evidence);
  archive("max_gap", merger.max_gap);
}

template <typename Archive>
void Fields(Archive& archive, LiveOptions& live) {
  archive("merger", live.merger);
  archive("max_scans", live.max_scans);
  archive("max_images", live.max_images);
  archive("max_imu", live.max_imu);
  archive("idle", live.idle);
}

template <typename Archive>
void Fields(Archive& archive, SlamNodeOptions& node) {
  archive("rig", node.rig);
  archive("rig_timeout", node.rig_timeout);
  archive("pipeline", node.pipeline);
  archive("features", node.features);
  archive("config", node.config);
  archive("threads", node.threads);
  archive("map_frame", node.map_frame);
  archive("odom_frame", node.odom_frame);
  archive("base_frame", node.base_frame);
  archive("publish_tf", node.publish_tf);
  archive("publish_sensor_frames", node.publish_sensor_frames);
  archive("tf_rate", node.tf_rate);
  archive("path_rate", node.path_rate);
  archive("map_period", node.map_period);
  archive("map_voxel_size", node.map_voxel_size);
  archive("map_max_points", node.map_max_points);
  archive("image_rate", node.image_rate);
  archive("diagnostics_period", node.diagnostics_period);
  archive("silence", node.silence);
  archive("live", node.live);
}

template <typename Archive>
void Fields(Archive& archive, SimNodeOptions& node) {
  archive("scenario", node.scenario);
  archive("rig_out", node.rig_out);
  archive("threads", node.threads);
  archive("rate", node.rate);
  archive("camera", node.camera);
  archive("quality", node.quality);
  archive("command_timeout", node.command_timeout);
  archive("publish_tf", node.publish_tf);
}

namespace {

template <typename Options>
Options Load(const YamlDocument& document) {
  Options options;
  FieldReader reader(document);
  Fields(reader, options);
  reader.Finish();
  reader.Check(options);
  return options;
}

template <typename Options>
std::string Write(Options options) {
  FieldWriter writer;
  Fields(writer, options);
  return writer.Text();
}

}  // namespace

SlamNodeOptions LoadSlamNode(const YamlDocument& document) {
  return Load<SlamNodeOptions>(document);
}
SimNodeOptions LoadSimNode(const YamlDocument& document) { return Load<SimNodeOptions>(document); }

std::string WriteSlamNode(const SlamNodeOptions& options) { return Write(options); }
std::string WriteSimNode(const SimNodeOptions& options) { return Write(options); }

}  // namespace regolith
