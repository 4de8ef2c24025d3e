// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace regolith {

struct SimulateArguments {
  std::string scenario;            ///< name in config/scenarios or a file
  std::string dem;                 ///< elevation model; empty generates the terrain
  std::optional<double> duration;  ///< s, instead of the scenario's
  std::optional<uint64_t> seed;    ///< instead of the scenario's
  std::vector<std::string> set;    ///< key=value over the scenario's
  std::string config;              ///< YAML over the scenario
  std::string out;
  bool overwrite = false;
  bool quiet = false;
  int threads = 2;
  std::string quality = "full";  ///< full, or draft: a coarser mesh
  int pairs = 0;                 ///< image pairs to write
  bool pairs_only = false;       ///< no recording
};

/// `regolith simulate`: drives a rover and writes the recording, its rig, truth, resolved scenario,
/// terrain and preview. Returns the exit code: 0, or 130 where it was interrupted and wrote what it
/// had.
int Simulate(const SimulateArguments& arguments);

}  // namespace regolith
