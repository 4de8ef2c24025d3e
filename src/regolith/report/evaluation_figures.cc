// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/evaluation_figures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "regolith/core/check.h"
#include "regolith/report/figures.h"
#include "regolith/report/gnuplot.h"
#include "regolith/report/html_text.h"

namespace regolith {
namespace {

constexpr double kDegreesPerRadian = 180.0 / M_PI;
constexpr size_t kMostTracks = 9;  // panels of `track_error`

/// Estimates may match different stretches of the reference; the longest shows most of it.
const Evaluation& Longest(const std::vector<FigureEstimate>& estimates) {
  const auto is_shorter = [](const FigureEstimate& first, const FigureEstimate& second) {
    return first.evaluation->length_m < second.evaluation->length_m;
  };
  return *std::max_element(estimates.begin(), estimates.end(), is_shorter)->evaluation;
}

TimeNs Start(const std::vector<FigureEstimate>& estimates) {
  TimeNs start = estimates.front().evaluation->reference.front().time;
  for (const FigureEstimate& one : estimates) {
    start = std::min(start, one.evaluation->reference.front().time);
  }
  return start;
}

std::vector<double> Seconds(const std::vector<StampedPose>& poses, TimeNs start) {
  std::vector<double> seconds;
  seconds.reserve(poses.size());
  for (const StampedPose& pose : poses) seconds.push_back(SecondsBetween(start, pose.time));
  return seconds;
}

double HeadingDegrees(const SE3& T_world_body) {
  const Eigen::Vector3d forward = T_world_body.rotation * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x()) * kDegreesPerRadian;
}

void DrawPaths(const std::string& folder, const std::vector<FigureEstimate>& estimates) {
  std::vector<FigureTrajectory> paths = {{"reference", Longest(estimates).reference}};
  for (const FigureEstimate& one : estimates) {
    paths.push_back({one.name, one.evaluation->estimate});
  }
  DrawTrajectories(folder, "Trajectories from above", paths);
}

/// Rows "seconds x y z heading", so that four panels share one file.
void AppendPoses(const std::string& name, const std::vector<StampedPose>& poses, TimeNs start,
                 std::string* data) {
  if (!data->empty()) *data += "\n\n";
  *data += "# " + name + "\n";
  double heading = 0.0;
  for (size_t i = 0; i < poses.size(); ++i) {
    // Unwound: a heading that passes 180 degrees goes on.
    const double wound = HeadingDegrees(poses[i].T_world_body);
    heading = i == 0 ? wound : heading + std::remainder(wound - heading, 360.0);
    const Eigen::Vector3d& place = poses[i].T_world_body.translation;
    for (const double value :
         {SecondsBetween(start, poses[i].time), place.x(), place.y(), place.z()}) {
      AppendNumber(value, 6, data);
      *data += ' ';
    }
    AppendNumber(heading, 4, data);
    *data += '\n';
  }
}

void DrawAxes(const std::string& folder, const std::vector<FigureEstimate>& estimates) {
  const TimeNs start = Start(estimates);
  std::string data;
  std::vector<std::string> names = {"reference"};
  AppendPoses(names.front(), Longest(estimates).reference, start, &data);
  for (const FigureEstimate& one : estimates) {
    AppendPoses(one.name, one.evaluation->estimate, start, &data);
    names.push_back(one.name);
  }
  std::string commands = FigureStyle() +
                         "set multiplot layout 4,1 margins 0.09,0.97,0.08,0.93 spacing 0,0.02\n"
                         "set format x ''\n";
  constexpr const char* kLabels[] = {"x, m", "y, m", "z, m", "heading, deg"};
  for (int row = 0; row < 4; ++row) {
    if (row == 1) commands += "unset key\n";
    if (row == 3) commands += "set format x '%g'\nset xlabel 'time, s'\n";
    commands += "set ylabel " + QuoteGnuplot(kLabels[row]) + "\n" +
                PlotLines("axes", names, Concatenate("1:", row + 2));
  }
  DrawWithGnuplot(folder, "axes", data, commands + "unset multiplot\n", {1200, 1100});
}

void DrawErrors(const std::string& folder, const std::vector<FigureEstimate>& estimates) {
  const TimeNs start = Start(estimates);
  std::vector<FigureSeries> over_time;
  std::vector<FigureSeries> over_distance;
  std::vector<FigureSeries> headings;
  for (const FigureEstimate& one : estimates) {
    const Evaluation& evaluation = *one.evaluation;
    const std::vector<double> seconds = Seconds(evaluation.reference, start);
    over_time.push_back({one.name, seconds, evaluation.ape_m});
    over_distance.push_back({one.name, evaluation.distance_m, evaluation.ape_m});
    headings.push_back({one.name, seconds, evaluation.yaw_deg});
  }
  DrawSeries(folder, "ape", {"Absolute pose error", "time, s", "APE, m", true}, over_time);
  DrawSeries(folder, "ape_distance",
             {"Absolute pose error over the path", "distance, m", "APE, m", true}, over_distance);
  DrawSeries(folder, "yaw", {"Error of the heading", "time, s", "heading, deg", false}, headings);
}

/// Every track in a panel of its own, one scale of colours for all.
void DrawTrackErrors(const std::string& folder, const std::vector<FigureEstimate>& estimates) {
  const size_t count = std::min(estimates.size(), kMostTracks);
  std::string data = "# x_m y_m error_m; one block an estimate\n";
  std::vector<double> errors;
  Eigen::AlignedBox2d box;
  for (size_t i = 0; i < count; ++i) {
    const Evaluation& evaluation = *estimates[i].evaluation;
    data += (i > 0 ? "\n\n# " : "# ") + estimates[i].name + "\n";
    for (size_t k = 0; k < evaluation.ape_m.size(); ++k) {
      const Eigen::Vector3d& place = evaluation.estimate[k].T_world_body.translation;
      for (const double value : {place.x(), place.y()}) {
        AppendNumber(value, 6, &data);
        data += ' ';
      }
      AppendNumber(evaluation.ape_m[k], 6, &data);
      data += '\n';
      errors.push_back(evaluation.ape_m[k]);
      box.extend(place.head<2>());
    }
  }
  std::sort(errors.begin(), errors.end());
  const double highest = errors[(errors.size() - 1) * 98 / 100];
  const auto columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  const int rows = (static_cast<int>(count) + columns - 1) / columns;
  const double shape = box.sizes().y() / std::max(box.sizes().x(), 1e-6);
  const int panel = static_cast<int>(110 + std::clamp(400.0 * shape, 130.0, 800.0));
  std::string commands =
      FigureStyle() +
      "set size ratio -1\nunset key\nset xlabel 'x, m'\nset ylabel 'y, m'\n"
      "set cblabel 'APE, m'\nset cbrange [0:" +
      Concatenate(std::max(highest, 1e-6), "]\nset cbtics ", std::max(highest, 1e-6) / 4.0,
                  " format '%.3g'\n") +
      "set palette defined (0 '#2c7bb6', 0.33 '#abd9e9', 0.66 '#fdae61', 1 '#d7191c')\n" +
      Concatenate("set multiplot layout ", rows, ",", columns, "\n");
  for (size_t i = 0; i < count; ++i) {
    commands += "set title " + QuoteGnuplot(estimates[i].name) + "\n" +
                Concatenate("plot 'track_error.dat' index ", i,
                            " using 1:2:3 with lines lw 4 lc palette z\n");
  }
  DrawWithGnuplot(folder, "track_error", data, commands + "unset multiplot\n",
                  {std::max(700, 560 * columns), panel * rows});
}

struct BoxLabels {
  const char* title;
  const char* value;
};

/// Lower whisker, quartiles, upper whisker (Tukey 1977: the outermost values within 1.5
/// interquartile ranges of the box).
std::array<double, 5> BoxOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<size_t>(place);
    const size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
  };
  const double low = at(0.25);
  const double high = at(0.75);
  const double reach = 1.5 * (high - low);
  const double lowest = *std::lower_bound(values.begin(), values.end(), low - reach);
  const double highest = *(std::upper_bound(values.begin(), values.end(), high + reach) - 1);
  return {lowest, low, at(0.5), high, highest};
}

/// gnuplot reads the labels of ticks as formats.
std::string EscapeFormat(const std::string& text) {
  std::string escaped;
  for (const char character : text) escaped += character == '%' ? "%%" : std::string(1, character);
  return escaped;
}

void DrawBoxes(const std::string& folder, const std::string& name, const BoxLabels& labels,
               const std::vector<std::pair<std::string, const std::vector<double>*>>& columns) {
  std::string data =
      "# place whisker quartile median quartile whisker (to 1.5 interquartile ranges)\n";
  std::string ticks;
  for (size_t i = 0; i < columns.size(); ++i) {
    data += Concatenate(i + 1);
    for (const double value : BoxOf(*columns[i].second)) {
      data += ' ';
      AppendNumber(value, 6, &data);
    }
    data += "  # " + columns[i].first + "\n";
    if (i > 0) ticks += ", ";
    ticks += QuoteGnuplot(EscapeFormat(columns[i].first)) + Concatenate(" ", i + 1);
  }
  const std::string file = "plot '" + name + ".dat' using ";
  const std::string commands =
      FigureStyle() + "set title " + QuoteGnuplot(labels.title) + "\nset ylabel " +
      QuoteGnuplot(labels.value) +
      "\nunset key\nset style fill solid 0.3 border\nset boxwidth 0.5\nset yrange [0:*]\n" +
      Concatenate("set xrange [0.4:", columns.size(), ".6]\n") + "set xtics (" + ticks +
      ") rotate by -25 nomirror\n" + file +
      "1:3:2:6:5 with candlesticks lw 2 lc rgb '#0072b2' whiskerbars 0.5, \\\n     '" + name +
      ".dat' using 1:4:4:4:4 with candlesticks lw 4 lc rgb '#d55e00'\n";
  DrawWithGnuplot(folder, name, data, commands,
                  {std::max(600, 200 + 130 * static_cast<int>(columns.size())), 700});
}

}  // namespace

void DrawEvaluation(const std::string& folder, const std::vector<FigureEstimate>& estimates) {
  REGOLITH_CHECK(!estimates.empty(), "no estimates");
  DrawPaths(folder, estimates);
  DrawAxes(folder, estimates);
  DrawErrors(folder, estimates);
  DrawTrackErrors(folder, estimates);
  std::vector<std::pair<std::string, const std::vector<double>*>> errors;
  std::vector<std::pair<std::string, const std::vector<double>*>> times;
  for (const FigureEstimate& one : estimates) {
    errors.emplace_back(one.name, &one.evaluation->ape_m);
    if (!one.frame_ms.empty()) times.emplace_back(one.name, &one.frame_ms);
  }
  DrawBoxes(folder, "ape_box", {"Absolute pose error", "APE, m"}, errors);
  if (!times.empty()) DrawBoxes(folder, "timing", {"Time of a frame", "ms"}, times);
}

}  // namespace regolith
