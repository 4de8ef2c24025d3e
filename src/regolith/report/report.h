// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "regolith/eval/error_statistics.h"
#include "regolith/geometry/trajectory.h"

namespace regolith {

/// A line of a table.
struct ReportItem {
  std::string name;
  std::string value;  ///< with its unit
};

struct ReportMapPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< world, m
  float value = 0.0F;                                  ///< what its colour shows
};

struct ReportStage {
  std::string name;
  double median_ms = 0.0;
  double p99_ms = 0.0;
};

/// A value over the time of the recording.
struct ReportSeries {
  std::string name;  ///< with its unit
  std::vector<double> seconds;
  std::vector<double> values;  ///< NaN leaves a gap
};

/// All that a report shows, as plain values. Empty parts are left out of the page.
struct ReportData {
  std::string title;
  std::string pipeline;
  std::vector<ReportItem> highlights;  ///< the few figures that stand above everything
  std::vector<ReportItem> summary;
  std::string configuration;  ///< text, shown as it is

  std::vector<StampedPose> estimate;   ///< T_world_body
  std::vector<StampedPose> reference;  ///< truth, in the frame of the estimate
  std::optional<ErrorStatistics> ape;  ///< m
  std::optional<ReportSeries> error;   ///< m, of each frame

  std::vector<ReportMapPoint> map;
  size_t map_total = 0;  ///< points before the caller thinned them; 0: all are given
  std::string map_value_name = "height, m";

  std::vector<ReportStage> stages;
  std::optional<ReportSeries> frame_ms;  ///< total time of each frame
  std::vector<ReportSeries> status;
};

/// No more points of the map than this are shown; the page says so.
inline constexpr size_t kReportMapPoints = 100000;

/// One self-contained page of HTML that works without a network. `plotly_path` is plotly.min.js;
/// where it cannot be read (or is empty), the page has tables and says why it has no figures. Same
/// data, same bytes.
std::string RenderReport(const ReportData& data, const std::string& plotly_path);

}  // namespace regolith
