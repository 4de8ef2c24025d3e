// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/core/check.h"

namespace regolith {

/// Parameters of regolith_sim_node.
struct SimNodeOptions {
  std::string scenario = "mars_dunes";  ///< name in config/scenarios, or a file
  std::string rig_out;                  ///< file that the rig is written to; empty: none
  int threads = 2;                      ///< that render
  double rate = 1.0;            ///< times real time, at most; it slows down where that is too fast
  std::string camera = "mono";  ///< the one that is rendered: mono, left, right; empty: none
  std::string quality = "draft";  ///< draft, or full: a finer mesh, light from lit ground
  double command_timeout = 0.5;   ///< s (simulated) after which the rover stops without /cmd_vel
  bool publish_tf = true;         ///< base_link → base of the robot's description; the truth

  /// Throws CheckError on values that make no node.
  void Check() const {
    REGOLITH_CHECK(threads >= 0, "threads=", threads);
    REGOLITH_CHECK(rate > 0.0, "rate=", rate);
    REGOLITH_CHECK(camera.empty() || camera == "mono" || camera == "left" || camera == "right",
                   "camera=", camera, "; expected mono, left, right or nothing");
    REGOLITH_CHECK(quality == "draft" || quality == "full", "quality=", quality);
    REGOLITH_CHECK(command_timeout > 0.0, "command_timeout=", command_timeout);
  }
};

}  // namespace regolith
