// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/run_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace regolith {
namespace {

std::string Text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// A value of the scans or of the images over the time from the first frame of either.
template <typename Value>
ReportSeries SeriesOf(const std::string& name, FrameSource source,
                      const std::vector<FrameReport>& frames, Value value) {
  ReportSeries series{name, {}, {}};
  if (frames.empty()) return series;
  const auto first = std::min_element(
      frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  for (const FrameReport& frame : frames) {
    if (frame.source != source) continue;
    series.seconds.push_back(SecondsBetween(first->stamp, frame.stamp));
    series.values.push_back(value(frame));
  }
  return series;
}

double TotalMilliseconds(const FrameReport& frame) {
  double total = 0.0;
  for (const StageTime& stage : frame.stages) total += stage.milliseconds;
  return total;
}

void AddError(const Evaluation& evaluation, TimeNs start, ReportData* data) {
  data->reference = ReferenceInEstimateFrame(evaluation.reference, evaluation.alignment);
  data->ape = evaluation.ape;
  ReportSeries error{"error, m", {}, evaluation.ape_m};
  for (const StampedPose& pose : evaluation.estimate) {
    error.seconds.push_back(SecondsBetween(start, pose.time));
  }
  data->error = error;
  data->highlights.push_back({"APE RMSE", Text("%.3f m", evaluation.ape.rmse)});
  if (evaluation.percent_of_distance) {
    data->highlights.push_back(
        {"of the distance", Text("%.2f %%", *evaluation.percent_of_distance)});
  }
}

void AddMap(const SlamSystem& system, ReportData* data) {
  const std::vector<MapPoint> points = system.MapPoints();
  const size_t step = points.size() / kReportMapPoints + 1;
  for (size_t i = 0; i < points.size(); i += step) {
    data->map.push_back({points[i].position, points[i].position.z()});
  }
  data->map_total = points.size();
}

void AddStatus(const std::vector<FrameReport>& frames, ReportData* data) {
  if (frames.empty()) return;
  const auto scans = FrameSource::kScan;
  data->frame_ms = SeriesOf("time a scan, ms", scans, frames, TotalMilliseconds);
  data->status = {SeriesOf("matched points", scans, frames,
                           [](const FrameReport& frame) { return frame.matches; }),
                  SeriesOf("degenerate directions", scans, frames,
                           [](const FrameReport& frame) { return frame.degenerate_directions; }),
                  SeriesOf("σ of the position, m", scans, frames, [](const FrameReport& frame) {
                    return std::sqrt(frame.covariance.bottomRightCorner<3, 3>().trace());
                  })};
  ReportSeries tracked = SeriesOf("tracked features", FrameSource::kImage, frames,
                                  [](const FrameReport& frame) { return frame.features.tracked; });
  if (!tracked.values.empty()) data->status.push_back(std::move(tracked));
}

}  // namespace

ReportData ReportOf(const RunSetup& setup, const SlamSystem& system, const RunRecord& record,
                    const std::optional<Evaluation>& evaluation) {
  ReportData data;
  data.title = setup.identity.path;
  data.pipeline = setup.pipeline.name;
  const double factor =
      record.wall_seconds > 0.0 ? record.recording_seconds / record.wall_seconds : 0.0;
  const Trajectory trajectory = system.trajectory();
  data.highlights = {{"distance", Text("%.1f m", trajectory.Length())},
                     {"real-time factor", Text("%.1f ×", factor)}};
  for (const StampedPose& pose : trajectory.poses()) data.estimate.push_back(pose);
  if (evaluation && !data.estimate.empty()) {
    AddError(*evaluation, data.estimate.front().time, &data);
  }
  data.summary = {{"complete", record.complete ? "yes" : "no: the run was ended early"},
                  {"recording", Text("%.1f s", record.recording_seconds)},
                  {"scans", std::to_string(system.scans_seen())},
                  {"poses", std::to_string(trajectory.size())},
                  {"images tracked", std::to_string(system.images_seen())},
                  {"wall time", Text("%.1f s", record.wall_seconds)},
                  {"processor time", Text("%.1f s", record.cpu_seconds)},
                  {"peak memory", Text("%.0f MB", record.peak_rss_mb)},
                  {"frame", setup.frame}};
  for (const std::string& notice : record.notices) data.summary.push_back({"notice", notice});
  data.configuration = ResolvedConfiguration(setup);
  AddMap(system, &data);
  for (const StageSummary& stage : SummariseStages(record.frames)) {
    data.stages.push_back({stage.name, stage.median_ms, stage.p99_ms});
  }
  AddStatus(record.frames, &data);
  return data;
}

}  // namespace regolith
