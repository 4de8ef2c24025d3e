// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
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
  float intensity = 0.0F;                              ///< as the lidar gives it
};

struct ReportStage {
  std::string name;
  double median_ms = 0.0;
  double p99_ms = 0.0;
};

/// A value over time.
struct ReportSeries {
  std::string name;
  std::vector<double> seconds;  ///< since ReportData::start
  std::vector<double> values;   ///< NaN leaves a gap
};

/// Series that share a figure.
struct ReportGroup {
  std::string title;
  std::string unit;
  bool stacked = false;  ///< areas on top of each other
  std::vector<ReportSeries> series;
};

/// What held from one time to another, seconds since ReportData::start.
struct ReportSpan {
  std::string name;
  double from = 0.0;
  double to = 0.0;
};

/// An accepted loop closure, world, m.
struct ReportLoop {
  TimeNs time = 0;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

struct ReportFeature {
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();
  Eigen::Vector2f next = Eigen::Vector2f::Zero();  ///< where it is in the following image
};

/// A sample image and the features in it.
struct ReportFrame {
  double seconds = 0.0;  ///< since ReportData::start
  std::string caption;
  int width = 0;
  int height = 0;
  std::vector<uint8_t> grey;  ///< width × height, row by row
  std::vector<ReportFeature> features;
};

/// All that the report of a run shows, as plain values. Empty parts are left out of the page.
struct ReportData {
  std::string title;
  std::string pipeline;
  std::vector<ReportItem> highlights;  ///< the few figures that stand above everything
  std::vector<ReportItem> summary;
  std::string configuration;  ///< text, shown as it is

  TimeNs start = 0;  ///< second 0 of all that is shown
  double duration = 0.0;

  std::vector<StampedPose> estimate;   ///< T_world_body
  std::vector<StampedPose> reference;  ///< truth, in the frame of the estimate
  std::vector<double> estimate_error;  ///< m, one a pose of the estimate; empty without truth
  std::vector<StampedPose> keyframes;
  std::vector<ReportLoop> loops;

  std::optional<ErrorStatistics> ape;  ///< m
  std::vector<ReportSeries> errors;    ///< m; the first is shown from the start
  std::optional<ReportSeries> yaw_error;

  std::vector<ReportMapPoint> map;
  size_t map_total = 0;  ///< points before the caller thinned them; 0: all are given

  std::vector<ReportStage> stages;
  std::vector<ReportSeries> features;  ///< the first one is also shown beside the map
  std::vector<ReportSpan> leader;
  std::optional<ReportSeries> degenerate;  ///< directions, 0 to 6
  std::vector<ReportGroup> groups;
  std::vector<ReportFrame> frames;
};

}  // namespace regolith
