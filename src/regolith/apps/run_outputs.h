// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regolith/apps/run.h"
#include "regolith/apps/run_monitor.h"
#include "regolith/apps/run_setup.h"
#include "regolith/eval/evaluation.h"
#include "regolith/system/slam_system.h"

namespace regolith {

/// What a run measured of itself.
struct RunRecord {
  bool complete = true;
  double recording_seconds = 0.0;  ///< from the first to the last measurement that was read
  double wall_seconds = 0.0;       ///< for them
  double cpu_seconds = 0.0;
  double peak_rss_mb = 0.0;
  /// At a pace (--rate): ms from when a frame was due to when its pose was known.
  std::vector<double> latencies;
  std::vector<FrameReport> frames;
  std::vector<std::string> notices;
  RunSamples samples;  ///< for the report
};

/// Error against the truth that lies beside the recording; nothing where there is none or it does
/// not fit.
std::optional<Evaluation> EvaluateAgainstTruth(const RunSetup& setup, const SlamSystem& system);

/// Writes every output of DESIGN §3 into the folder; trajectories, map and tables of an incomplete
/// run get names with
/// `.partial.`. Throws OutputError.
void WriteRunOutputs(const std::string& folder, const RunSetup& setup, const SlamSystem& system,
                     const RunRecord& record, const std::optional<Evaluation>& evaluation);

}  // namespace regolith
