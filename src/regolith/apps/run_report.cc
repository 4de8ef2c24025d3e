// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/run_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "regolith/apps/number_text.h"
#include "regolith/apps/run_frames.h"
#include "regolith/core/version.h"
#include "regolith/report/report_map.h"

namespace regolith {
namespace {

/// "features_extract_network" as people read it.
std::string StageName(std::string name) {
  for (const std::string prefix : {"features_extract_", "features_"}) {
    if (name.rfind(prefix, 0) != 0) continue;
    name = name.substr(prefix.size());
    break;
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

TimeNs FirstStamp(const std::vector<FrameReport>& frames) {
  const auto first = std::min_element(
      frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return first == frames.end() ? 0 : first->stamp;
}

/// A value of the scans or of the images over time; nothing where there are none.
template <typename Value>
void AppendSeries(const std::string& name, FrameSource source, const RunRecord& record,
                  TimeNs start, Value value, std::vector<ReportSeries>* list) {
  ReportSeries series{name, {}, {}};
  for (const FrameReport& frame : record.frames) {
    if (frame.source != source) continue;
    series.seconds.push_back(SecondsBetween(start, frame.stamp));
    series.values.push_back(value(frame));
  }
  if (!series.values.empty()) list->push_back(std::move(series));
}

/// Errors that belong to poses of the estimate, NaN for those that truth says nothing of.
std::vector<double> ErrorsOf(const std::vector<StampedPose>& estimate,
                             const Evaluation& evaluation) {
  std::map<TimeNs, double> known;
  for (size_t i = 0; i < evaluation.estimate.size(); ++i) {
    known[evaluation.estimate[i].time] = evaluation.ape_m[i];
  }
  std::vector<double> errors;
  for (const StampedPose& pose : estimate) {
    const auto found = known.find(pose.time);
    errors.push_back(found == known.end() ? std::nan("") : found->second);
  }
  return errors;
}

void AddError(const Evaluation& evaluation, ReportData* data) {
  data->reference = ReferenceInEstimateFrame(evaluation.reference, evaluation.alignment);
  data->estimate_error = ErrorsOf(data->estimate, evaluation);
  data->ape = evaluation.ape;
  std::vector<double> seconds;
  for (const StampedPose& pose : evaluation.estimate) {
    seconds.push_back(SecondsBetween(data->start, pose.time));
  }
  data->errors.push_back({"distance", seconds, evaluation.ape_m});
  constexpr const char* kAxes[] = {"along x", "along y", "along z"};
  for (int axis = 0; axis < 3; ++axis) {
    ReportSeries series{kAxes[axis], seconds, {}};
    for (const Eigen::Vector3d& offset : evaluation.offsets_m) {
      series.values.push_back(offset[axis]);
    }
    data->errors.push_back(std::move(series));
  }
  data->yaw_error = ReportSeries{"heading", seconds, evaluation.yaw_deg};
  data->highlights.push_back({"error (APE RMSE)", Text("%.3f m", evaluation.ape.rmse)});
  if (evaluation.percent_of_distance) {
    data->highlights.push_back(
        {"of the distance", Text("%.2f %%", *evaluation.percent_of_distance)});
  }
  if (evaluation.drift_percent) {
    data->highlights.push_back({"drift over 10 m", Text("%.2f %%", *evaluation.drift_percent)});
  }
}

void AddMap(const SlamSystem& system, ReportData* data) {
  const std::vector<MapPoint> points = system.MapPoints();
  for (const size_t i : ThinEvenly(points.size(), kReportMapPoints)) {
    data->map.push_back({points[i].position, points[i].intensity});
  }
  data->map_total = points.size();
}

void ExtendSpan(const std::string& name, double seconds, std::vector<ReportSpan>* spans) {
  if (!spans->empty()) spans->back().to = seconds;
  if (spans->empty() || spans->back().name != name) spans->push_back({name, seconds, seconds});
}

/// Of scans which subsystem led; without scans the health of visual odometry.
void AddLeader(const RunRecord& record, ReportData* data) {
  std::vector<ReportSpan> health;
  for (const FrameReport& frame : record.frames) {
    const double seconds = SecondsBetween(data->start, frame.stamp);
    if (frame.source == FrameSource::kScan) {
      ExtendSpan(frame.leader.empty() ? "nothing" : frame.leader, seconds, &data->leader);
    } else if (frame.visual) {
      ExtendSpan(VioHealthName(frame.visual->health), seconds, &health);
    }
  }
  if (data->leader.empty()) data->leader = health;
  std::vector<ReportSeries> degenerate;
  AppendSeries(
      "degenerate directions", FrameSource::kScan, record, data->start,
      [](const FrameReport& frame) { return frame.degenerate_directions; }, &degenerate);
  if (!degenerate.empty()) data->degenerate = degenerate.front();
}

/// Where the back end has set keyframes, and the loops between them; else where visual odometry
/// has.
void AddKeyframes(const SlamSystem& system, const RunRecord& record, const Trajectory& trajectory,
                  ReportData* data) {
  if (const Backend* backend = system.backend()) {
    for (size_t i = 0; i < backend->keyframes().size(); ++i) {
      data->keyframes.push_back({backend->keyframes()[i].time, backend->T_world_body(i)});
    }
    for (const LoopRecord& loop : backend->loops()) {
      if (loop.verdict.outcome != LoopOutcome::kAccepted) continue;
      data->loops.push_back({backend->keyframes()[loop.new_keyframe].time,
                             backend->T_world_body(loop.old_keyframe).translation,
                             backend->T_world_body(loop.new_keyframe).translation});
    }
    return;
  }
  for (const FrameReport& frame : record.frames) {
    if (!frame.visual || !frame.visual->is_keyframe) continue;
    const auto T_world_body = trajectory.At(frame.stamp);
    if (T_world_body) data->keyframes.push_back({frame.stamp, *T_world_body});
  }
}

/// A value of visual odometry, NaN where it said nothing.
template <typename Value>
void AppendVisual(const std::string& name, const RunRecord& record, TimeNs start, Value value,
                  std::vector<ReportSeries>* list) {
  const bool has_any =
      std::any_of(record.frames.begin(), record.frames.end(),
                  [](const FrameReport& frame) { return frame.visual.has_value(); });
  if (!has_any) return;
  AppendSeries(
      name, FrameSource::kImage, record, start,
      [&](const FrameReport& frame) {
        return frame.visual ? static_cast<double>(value(*frame.visual)) : std::nan("");
      },
      list);
}

ReportGroup Landmarks(const RunRecord& record, TimeNs start) {
  ReportGroup group{"Landmarks of visual odometry", "landmarks", false, {}};
  const auto add = [&](const char* name, auto value) {
    AppendVisual(name, record, start, value, &group.series);
  };
  add("in the window", [](const VioEstimate& visual) { return visual.landmarks; });
  add("outliers", [](const VioEstimate& visual) { return visual.outliers; });
  add("with a distance by lidar",
      [](const VioEstimate& visual) { return visual.measured_distances; });
  return group;
}

void AddFeatures(const RunRecord& record, ReportData* data) {
  const auto add = [&](const char* name, auto value) {
    AppendSeries(name, FrameSource::kImage, record, data->start, value, &data->features);
  };
  add("tracked", [](const FrameReport& frame) { return frame.features.tracked; });
  add("new", [](const FrameReport& frame) { return frame.features.started; });
  add("recovered", [](const FrameReport& frame) { return frame.features.recovered; });
  add("rejected", [](const FrameReport& frame) { return frame.features.rejected; });
}

/// Time of every stage of the scans or of the images, one on top of the other.
ReportGroup StageTimes(const char* title, FrameSource source, const RunRecord& record,
                       TimeNs start) {
  ReportGroup group{title, "ms", true, {}};
  std::vector<std::string> names;
  for (const FrameReport& frame : record.frames) {
    if (frame.source != source) continue;
    for (const StageTime& stage : frame.stages) {
      if (std::find(names.begin(), names.end(), stage.name) == names.end()) {
        names.emplace_back(stage.name);
      }
    }
  }
  for (const std::string& name : names) {
    AppendSeries(
        name, source, record, start,
        [&](const FrameReport& frame) {
          double total = 0.0;
          for (const StageTime& stage : frame.stages) {
            total += name == stage.name ? stage.milliseconds : 0.0;
          }
          return total;
        },
        &group.series);
  }
  return group;
}

ReportGroup Matching(const RunRecord& record, TimeNs start) {
  ReportGroup group{"Points of a scan", "points", false, {}};
  AppendSeries(
      "matched with the map", FrameSource::kScan, record, start,
      [](const FrameReport& frame) { return frame.matches; }, &group.series);
  AppendSeries(
      "of them inliers", FrameSource::kScan, record, start,
      [](const FrameReport& frame) { return frame.inliers; }, &group.series);
  return group;
}

ReportGroup Uncertainty(const RunRecord& record, TimeNs start) {
  ReportGroup group{"Standard deviation that the estimator states", "m, °", false, {}};
  AppendSeries(
      "position, m", FrameSource::kScan, record, start,
      [](const FrameReport& frame) {
        return std::sqrt(frame.covariance.bottomRightCorner<3, 3>().trace());
      },
      &group.series);
  AppendSeries(
      "attitude, °", FrameSource::kScan, record, start,
      [](const FrameReport& frame) {
        return std::sqrt(frame.covariance.topLeftCorner<3, 3>().trace()) * 180.0 / M_PI;
      },
      &group.series);
  return group;
}

/// The same of visual odometry where no scan led.
ReportGroup VisualUncertainty(const RunRecord& record, TimeNs start) {
  ReportGroup group{"Standard deviation that visual odometry states", "m", false, {}};
  AppendVisual(
      "position, m", record, start,
      [](const VioEstimate& visual) {
        return std::sqrt(visual.covariance.block<3, 3>(3, 3).trace());
      },
      &group.series);
  return group;
}

/// Processor seconds a second of the recording: the cores that it would keep busy at its own pace.
ReportGroup Load(const std::vector<LoadSample>& load, TimeNs start) {
  ReportGroup group{"Load at the recording's own pace", "cores", false, {{"cores", {}, {}}}};
  for (size_t i = 1; i < load.size(); ++i) {
    const double step = SecondsBetween(load[i - 1].time, load[i].time);
    if (!(step > 0.0)) continue;
    group.series[0].seconds.push_back(SecondsBetween(start, load[i].time));
    group.series[0].values.push_back((load[i].cpu_seconds - load[i - 1].cpu_seconds) / step);
  }
  return group;
}

ReportGroup Memory(const std::vector<LoadSample>& load, TimeNs start) {
  ReportGroup group{"Memory", "MB", false, {{"resident", {}, {}}}};
  for (const LoadSample& sample : load) {
    group.series[0].seconds.push_back(SecondsBetween(start, sample.time));
    group.series[0].values.push_back(sample.memory_mb);
  }
  return group;
}

void AddGroups(const RunRecord& record, ReportData* data) {
  const TimeNs start = data->start;
  for (ReportGroup& group : std::vector<ReportGroup>{
           StageTimes("Time of a scan by stage", FrameSource::kScan, record, start),
           StageTimes("Time of an image by stage", FrameSource::kImage, record, start),
           Matching(record, start), Uncertainty(record, start), Landmarks(record, start),
           VisualUncertainty(record, start), Load(record.samples.load, start),
           Memory(record.samples.load, start)}) {
    const bool is_empty = group.series.empty() || group.series.front().values.empty();
    if (!is_empty) data->groups.push_back(std::move(group));
  }
}

std::vector<ReportItem> SummaryItems(const RunSetup& setup, const SlamSystem& system,
                                     const RunRecord& record) {
  const KeyframeCounts counts = system.keyframe_counts();
  std::vector<ReportItem> items = {
      {"complete", record.complete ? "yes" : "no: the run was ended early"},
      {"recording", setup.identity.path},
      {"length of the recording", Text("%.1f s", record.recording_seconds)},
      {"scans", std::to_string(system.scans_seen())},
      {"poses", std::to_string(system.trajectory().size())}};
  if (system.images_seen() > 0) {
    items.push_back({"images tracked", std::to_string(system.images_seen()) + ", by " +
                                           setup.pipeline.features.frontend});
    items.push_back({"features tracked, median", Text("%.0f", MedianTracked(record.frames))});
  }
  if (counts.keyframes > 0) {
    items.push_back({"keyframes", std::to_string(counts.keyframes)});
    items.push_back({"loops", std::to_string(counts.loops_accepted) + " accepted, " +
                                  std::to_string(counts.loops_rejected) + " refused"});
  }
  items.push_back({"wall time", Text("%.1f s", record.wall_seconds)});
  items.push_back({"processor time", Text("%.1f s", record.cpu_seconds)});
  items.push_back({"peak memory", Text("%.0f MB", record.peak_rss_mb)});
  items.push_back({"frame of the trajectories", setup.frame});
  items.push_back({"version", ProgramVersion()});
  for (const std::string& notice : record.notices) items.push_back({"notice", notice});
  return items;
}

std::string TitleOf(const std::string& recording) {
  const std::filesystem::path path = std::filesystem::path(recording).lexically_normal();
  return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

}  // namespace

ReportData ReportOf(const RunSetup& setup, const SlamSystem& system, const RunRecord& record,
                    const std::optional<Evaluation>& evaluation) {
  ReportData data;
  data.title = TitleOf(setup.identity.path);
  data.pipeline = setup.pipeline.name;
  data.start = FirstStamp(record.frames);
  for (const FrameReport& frame : record.frames) {
    data.duration = std::max(data.duration, SecondsBetween(data.start, frame.stamp));
  }
  const Trajectory trajectory = system.trajectory();
  for (const StampedPose& pose : trajectory.poses()) data.estimate.push_back(pose);
  data.highlights = {{"distance", Text("%.1f m", trajectory.Length())}};
  if (evaluation && !data.estimate.empty()) AddError(*evaluation, &data);
  if (record.wall_seconds > 0.0) {
    data.highlights.push_back(
        {"real-time factor", Text("%.1f ×", record.recording_seconds / record.wall_seconds)});
  }
  if (system.images_seen() > 0) {
    data.highlights.push_back({"features tracked", Text("%.0f", MedianTracked(record.frames))});
  }
  data.highlights.push_back({"memory", Text("%.0f MB", record.peak_rss_mb)});
  data.summary = SummaryItems(setup, system, record);
  data.configuration = ResolvedConfiguration(setup);
  AddMap(system, &data);
  for (const StageSummary& stage : SummariseStages(record.frames)) {
    const bool of_image = stage.name.rfind("features_", 0) == 0;
    data.stages.push_back(
        {(of_image ? "image: " : "") + StageName(stage.name), stage.median_ms, stage.p99_ms});
  }
  AddFeatures(record, &data);
  AddKeyframes(system, record, trajectory, &data);
  AddLeader(record, &data);
  AddGroups(record, &data);
  data.frames = SampleFrames(setup, record.samples.images, data.start);
  return data;
}

}  // namespace regolith
