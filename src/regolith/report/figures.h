// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "regolith/geometry/trajectory.h"

namespace regolith {

struct FigureTrajectory {
  std::string name;
  std::vector<StampedPose> poses;
};

struct FigureSeries {
  std::string name;
  std::vector<double> seconds;
  std::vector<double> values;
};

/// trajectory.{dat,gp,png,svg} in `folder`: paths seen from above, x to the right, y up, one scale.
/// False, after a warning, where gnuplot is missing; throws OutputError where nothing can be
/// written.
bool DrawTrajectories(const std::string& folder, const std::string& title,
                      const std::vector<FigureTrajectory>& trajectories);

/// NAME.{dat,gp,png,svg} in `folder`: values over time in seconds.
bool DrawSeries(const std::string& folder, const std::string& name, const std::string& title,
                const std::string& value_label, const std::vector<FigureSeries>& series);

}  // namespace regolith
