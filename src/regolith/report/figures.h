// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
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
  std::vector<double> seconds;  ///< or whatever the horizontal axis shows
  std::vector<double> values;
};

struct FigureLabels {
  std::string title;
  std::string x;
  std::string y;
  bool from_zero = true;  ///< the vertical axis starts at 0
};

/// Colours that colour-blind readers tell apart (Okabe, Ito 2008), over and over; dark grey for
/// what is called "reference". So an estimate has the same one in every figure, with or without it.
std::vector<std::string> FigureColors(const std::vector<std::string>& names);

/// The commands that all figures begin with: grid, key above the plot, null for missing values.
std::string FigureStyle();

/// A plot command of the blocks of FILE.dat, one a name; `columns` as of gnuplot's `using`.
std::string PlotLines(const std::string& file, const std::vector<std::string>& names,
                      const std::string& columns);

/// trajectory.{dat,gp,png,svg} in `folder`: paths seen from above, x to the right, y up, one scale.
/// False, after a warning, where gnuplot is missing; throws OutputError where nothing can be
/// written.
bool DrawTrajectories(const std::string& folder, const std::string& title,
                      const std::vector<FigureTrajectory>& trajectories,
                      const std::string& name = "trajectory");

/// NAME.{dat,gp,png,svg} in `folder`: values over time.
bool DrawSeries(const std::string& folder, const std::string& name, const FigureLabels& labels,
                const std::vector<FigureSeries>& series);

}  // namespace regolith
