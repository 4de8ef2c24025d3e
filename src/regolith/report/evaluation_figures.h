// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "regolith/eval/evaluation.h"

namespace regolith {

/// One estimate as figures show it.
struct FigureEstimate {
  std::string name;
  const Evaluation* evaluation = nullptr;
  std::vector<double> frame_ms;  ///< processing time of each frame; empty: not known
};

/// Into `folder`, each as {dat,gp,png,svg}: `trajectory` (from above), `axes` (x, y, z and heading
/// over time), `ape` (error over time), `ape_distance` (over the path), `yaw` (error of the heading
/// over time), `track_error` (the tracks, coloured by error), `ape_box` (box plots) and, where
/// times are known, `timing` (box plots). Throws CheckError without estimates, OutputError where a
/// file cannot be written.
void DrawEvaluation(const std::string& folder, const std::vector<FigureEstimate>& estimates);

}  // namespace regolith
