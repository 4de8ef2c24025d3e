// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/figures.h"

#include <algorithm>
#include <iterator>

#include <Eigen/Geometry>

#include "regolith/core/check.h"
#include "regolith/report/gnuplot.h"
#include "regolith/report/html_text.h"

namespace regolith {
namespace {

constexpr int kDecimals = 6;

// Blue, orange, green, pink, yellow, brown: apart for colour-blind readers too (Okabe, Ito 2008).
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73",
                                   "#cc79a7", "#e69f00", "#8c6d1f"};

void AppendRow(double first, double second, std::string* data) {
  AppendNumber(first, kDecimals, data);
  *data += ' ';
  AppendNumber(second, kDecimals, data);
  *data += '\n';
}

std::string Labels(const std::string& title, const std::string& x_label,
                   const std::string& y_label) {
  return FigureStyle() + "set title " + QuoteGnuplot(title) + "\nset xlabel " +
         QuoteGnuplot(x_label) + "\nset ylabel " + QuoteGnuplot(y_label) + "\n";
}

/// The picture takes the shape of what it shows, within bounds.
GnuplotSize SizeFor(const std::vector<FigureTrajectory>& trajectories) {
  Eigen::AlignedBox2d box;
  for (const FigureTrajectory& trajectory : trajectories) {
    for (const StampedPose& pose : trajectory.poses) {
      box.extend(pose.T_world_body.translation.head<2>());
    }
  }
  constexpr double kFrame = 170.0;  // pixels of title, key and labels
  GnuplotSize size;
  if (box.isEmpty() || !(box.sizes().x() > 0.0)) return size;
  const double shape = box.sizes().y() / box.sizes().x();
  size.height = static_cast<int>(kFrame + std::clamp(1100.0 * shape, 350.0, 1300.0));
  return size;
}

}  // namespace

std::vector<std::string> FigureColors(const std::vector<std::string>& names) {
  std::vector<std::string> colors;
  size_t next = 0;
  for (const std::string& name : names) {
    colors.push_back(name == "reference" ? "#444444" : kColors[next++ % std::size(kColors)]);
  }
  return colors;
}

std::string FigureStyle() {
  return "set datafile missing 'null'\nset grid lc rgb '#dddddd' lt 1\n"
         "set key outside top center horizontal\n";
}

std::string PlotLines(const std::string& file, const std::vector<std::string>& names,
                      const std::string& columns) {
  const std::vector<std::string> colors = FigureColors(names);
  std::string command = "plot ";
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) command += ", \\\n     ";
    command +=
        Concatenate("'", file, ".dat' index ", i, " using ", columns, " with lines lw 2 lc rgb '",
                    colors[i], "' title ", QuoteGnuplot(names[i]));
  }
  return command + "\n";
}

bool DrawTrajectories(const std::string& folder, const std::string& title,
                      const std::vector<FigureTrajectory>& trajectories, const std::string& name) {
  REGOLITH_CHECK(!trajectories.empty(), "no trajectories");
  std::string data = "# x_m y_m; one block a trajectory\n";
  std::vector<std::string> names;
  for (const FigureTrajectory& trajectory : trajectories) {
    if (!names.empty()) data += "\n\n";
    names.push_back(trajectory.name);
    data += "# " + trajectory.name + "\n";
    for (const StampedPose& pose : trajectory.poses) {
      AppendRow(pose.T_world_body.translation.x(), pose.T_world_body.translation.y(), &data);
    }
  }
  return DrawWithGnuplot(
      folder, name, data,
      Labels(title, "x, m", "y, m") + "set size ratio -1\n" + PlotLines(name, names, "1:2"),
      SizeFor(trajectories));
}

bool DrawSeries(const std::string& folder, const std::string& name, const FigureLabels& labels,
                const std::vector<FigureSeries>& series) {
  REGOLITH_CHECK(!series.empty(), "no series");
  std::string data = "# " + labels.x + "; " + labels.y + "; one block a series\n";
  std::vector<std::string> names;
  for (const FigureSeries& one : series) {
    REGOLITH_CHECK(one.seconds.size() == one.values.size(), one.name);
    if (!names.empty()) data += "\n\n";
    names.push_back(one.name);
    data += "# " + one.name + "\n";
    for (size_t i = 0; i < one.values.size(); ++i) AppendRow(one.seconds[i], one.values[i], &data);
  }
  return DrawWithGnuplot(folder, name, data,
                         Labels(labels.title, labels.x, labels.y) +
                             (labels.from_zero ? "set yrange [0:*]\n" : "") +
                             PlotLines(name, names, "1:2"),
                         GnuplotSize());
}

}  // namespace regolith
