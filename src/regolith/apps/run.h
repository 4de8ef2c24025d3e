// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace regolith {

struct RunArguments {
  std::string recording;
  std::string rig;
  std::string pipeline = "regolith";
  double rate = 0.0;               ///< 1: at the recording's own pace; 0: as fast as it goes
  std::vector<std::string> drops;  ///< TOPIC:START:END, s from the recording's start
  std::string features;            ///< frontend instead of the pipeline's; empty: that one
  std::string frame;               ///< imu, lidar, camera, base; empty: the body
  std::string config;
  std::vector<std::string> set;
  int threads = 2;
  std::string out;
  bool overwrite = false;
  bool quiet = false;
};

/// `regolith run`: estimates a recording and writes trajectory, map, timing, status, summary and
/// report. Returns the exit code: 0, or 130 where it was interrupted and wrote what it had.
int Run(const RunArguments& arguments);

}  // namespace regolith
