// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/core/check.h"
#include "regolith/system/live_options.h"

namespace regolith {

/// Parameters of regolith_node.
struct SlamNodeOptions {
  std::string rig;            ///< file; needed
  double rig_timeout = 10.0;  ///< s that it waits for that file, which a simulator may write
  std::string pipeline = "regolith";  ///< name in config/pipelines, or a file
  std::string features;               ///< frontend, instead of the pipeline's
  std::string config;                 ///< YAML file over the pipeline's settings
  int threads = 2;                    ///< that estimate; 0: one a core

  std::string map_frame = "map";         ///< jumps with loops (REP 105)
  std::string odom_frame = "odom";       ///< smooth
  std::string base_frame = "base_link";  ///< the rig's `base`; without wheels the IMU's place
  bool publish_tf = true;                ///< map → odom → base
  bool publish_sensor_frames = true;     ///< base → imu, lidar, cameras, as the rig says
  double tf_rate = 50.0;                 ///< Hz, at most

  double path_rate = 5.0;           ///< Hz, at most
  double map_period = 3.0;          ///< s between two clouds of the map
  double map_voxel_size = 0.2;      ///< m, one point a voxel is sent
  int map_max_points = 300000;      ///< beyond them the voxels double
  double image_rate = 5.0;          ///< Hz, at most, of the image with features
  double diagnostics_period = 1.0;  ///< s
  double silence = 2.0;             ///< s without a message, after which a topic is an error

  LiveOptions live;

  /// Throws CheckError on values that make no node.
  void Check() const {
    REGOLITH_CHECK(threads >= 0, "threads=", threads);
    REGOLITH_CHECK(rig_timeout >= 0.0, "rig_timeout=", rig_timeout);
    for (const double value : {tf_rate, path_rate, map_period, map_voxel_size, image_rate,
                               diagnostics_period, silence}) {
      REGOLITH_CHECK(value > 0.0, "value=", value);
    }
    REGOLITH_CHECK(map_max_points >= 1, "map_max_points=", map_max_points);
    REGOLITH_CHECK(!map_frame.empty() && !odom_frame.empty() && !base_frame.empty(),
                   "a frame without a name");
    live.Check();
  }
};

}  // namespace regolith
