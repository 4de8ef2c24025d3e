// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/run_outputs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "regolith/apps/run_report.h"
#include "regolith/config/install_paths.h"
#include "regolith/config/pipeline_config.h"
#include "regolith/config/rig_config.h"
#include "regolith/core/log.h"
#include "regolith/core/version.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/ply.h"
#include "regolith/io/tum.h"

namespace regolith {
namespace {

std::vector<StampedPose> InFrame(const Trajectory& trajectory, const SE3& T_body_frame) {
  std::vector<StampedPose> poses;
  for (const StampedPose& pose : trajectory.poses()) {
    poses.push_back({pose.time, pose.T_world_body * T_body_frame});
  }
  return poses;
}

std::string SecondsText(TimeNs time) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%lld.%09lld", static_cast<long long>(time / 1000000000),
                static_cast<long long>(std::abs(time % 1000000000)));
  return buffer;
}

void WriteTable(const std::string& path, const std::string& text, bool complete) {
  AtomicFile file(path);
  file.Write(text);
  file.Commit(!complete);
}

std::string TimingTable(const std::vector<FrameReport>& frames) {
  std::string text = "time_s,stage,milliseconds\n";
  for (const FrameReport& frame : frames) {
    for (const StageTime& stage : frame.stages) {
      text += SecondsText(frame.stamp) + "," + stage.name + "," +
              std::to_string(stage.milliseconds) + "\n";
    }
  }
  return text;
}

std::string ScanCells(const FrameReport& frame) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, ",%d,0,%d,%d,%.1f,%.5f,%d", frame.at_rest ? 1 : 0,
                frame.points, frame.matches, frame.inliers, frame.residual_scale,
                frame.degenerate_directions);
  std::string text = buffer;
  for (int i = 0; i < 6; ++i) {
    std::snprintf(buffer, sizeof buffer, ",%.3e", std::sqrt(frame.covariance(i, i)));
    text += buffer;
  }
  text += std::string(11, ',');
  std::snprintf(buffer, sizeof buffer, ",%.3f,%.3f,%.3f,%.3f", frame.weakest_ratio,
                frame.weakest_position.x(), frame.weakest_position.y(), frame.weakest_position.z());
  return text + buffer;
}

std::string ImageCells(const FrameReport& frame) {
  const FrontendStatus& status = frame.features;
  const DetectionStatus& detection = status.detection;
  char buffer[240];
  std::snprintf(buffer, sizeof buffer,
                ",%s,%d,,,,,,,,,,,,%d,%d,%d,%d,%.2f,%d,%d,%d,%.6g,%.6g,%.6g,,,,",
                frame.visual ? (frame.at_rest ? "1" : "0") : "", status.tracked, status.detected,
                status.recovered, status.rejected, status.started, status.mean_age, detection.cells,
                detection.cells_filled, detection.rounds, detection.threshold_min,
                detection.threshold_median, detection.threshold_max);
  return buffer;
}

std::string VisualCells(const std::optional<VioEstimate>& visual) {
  if (!visual) return ",,,,,,,,";
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, ",%s,%d,%d,%d,%d,%.3f,%.4f,%.5f",
                VioHealthName(visual->health), visual->is_keyframe ? 1 : 0, visual->landmarks,
                visual->measured_distances, visual->outliers, visual->visual_cost, visual->slip,
                visual->time_offset);
  return buffer;
}

/// In the columns of visual odometry that it has too.
std::string StereoCells(const StereoEstimate& stereo) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, ",%s,%d,%d,%d,%d,,,", StereoHealthName(stereo.health),
                stereo.is_keyframe ? 1 : 0, stereo.tracking.inliers, stereo.tracking.close_tracked,
                stereo.tracking.outliers);
  return buffer;
}

std::string SupervisorCells(const FrameReport& frame) {
  std::string text = std::string(",") + (frame.led_by ? SubsystemName(*frame.led_by) : "nobody");
  for (const SubsystemState state : frame.states) {
    text += std::string(",") + SubsystemStateName(state);
  }
  return text;
}

std::string StatusTable(const std::vector<FrameReport>& frames) {
  std::string text =
      "time_s,leader,at_rest,tracked_features,points,matches,inliers,residual_scale_m,"
      "degenerate_directions,sigma_roll_rad,sigma_pitch_rad,sigma_yaw_rad,sigma_x_m,sigma_y_m,"
      "sigma_z_m,detected_features,recovered_features,rejected_features,new_features,mean_age,"
      "cells,"
      "cells_filled,threshold_rounds,threshold_min,threshold_median,threshold_max,weakest_ratio,"
      "weakest_x,weakest_y,weakest_z,health,keyframe,landmarks,measured_distances,visual_outliers,"
      "visual_cost,slip,"
      "time_offset_s,led_by,lidar,camera,wheels,imu\n";
  for (const FrameReport& frame : frames) {
    text += SecondsText(frame.stamp) + "," + frame.leader;
    text += frame.source == FrameSource::kScan ? ScanCells(frame) : ImageCells(frame);
    text += frame.stereo ? StereoCells(*frame.stereo) : VisualCells(frame.visual);
    text += SupervisorCells(frame) + "\n";
  }
  return text;
}

std::string LoopTable(const Backend& backend) {
  std::string text =
      "old_time_s,new_time_s,outcome,agreement,runner_up,matches,scale_m,x_m,y_m,z_m,qx,qy,qz,qw,"
      "proposed_by\n";
  for (const LoopRecord& loop : backend.loops()) {
    const LoopVerdict& verdict = loop.verdict;
    const SE3& T_old_new = verdict.T_target_query.T_a_b;
    char buffer[320];
    std::snprintf(
        buffer, sizeof buffer, ",%s,%.3f,%.3f,%.3f,%.4f,%.4f,%.4f,%.4f,%.6f,%.6f,%.6f,%.6f,%s\n",
        LoopOutcomeName(verdict.outcome), verdict.agreement, verdict.relief.runner_up,
        verdict.matches, verdict.scale, T_old_new.translation.x(), T_old_new.translation.y(),
        T_old_new.translation.z(), T_old_new.rotation.x(), T_old_new.rotation.y(),
        T_old_new.rotation.z(), T_old_new.rotation.w(), LoopSourceName(loop.source));
    text += SecondsText(backend.keyframes()[loop.old_keyframe].time) + "," +
            SecondsText(backend.keyframes()[loop.new_keyframe].time) + buffer;
  }
  return text;
}

nlohmann::ordered_json SummaryOf(const RunSetup& setup, const SlamSystem& system,
                                 const RunRecord& record,
                                 const std::optional<Evaluation>& evaluation) {
  nlohmann::ordered_json summary;
  summary["complete"] = record.complete;
  summary["pipeline"] = setup.pipeline.name;
  summary["version"] = ProgramVersion();
  summary["recording"] = setup.identity.path;
  summary["recording_seconds"] = record.recording_seconds;
  summary["wall_seconds"] = record.wall_seconds;
  summary["real_time_factor"] =
      record.wall_seconds > 0.0 ? record.recording_seconds / record.wall_seconds : 0.0;
  summary["cpu_seconds"] = record.cpu_seconds;
  summary["peak_rss_mb"] = record.peak_rss_mb;
  if (!record.latencies.empty()) {
    summary["latency_ms"] = {{"median", Quantile(record.latencies, 0.5)},
                             {"p99", Quantile(record.latencies, 0.99)}};
  }
  summary["frames"] = system.images_seen();
  summary["scans"] = system.scans_seen();
  const KeyframeCounts counts = system.keyframe_counts();
  summary["keyframes"] = counts.keyframes;
  summary["loops_accepted"] = counts.loops_accepted;
  summary["loops_rejected"] = counts.loops_rejected;
  summary["coverage"] = system.stamps_seen() == 0
                            ? 0.0
                            : static_cast<double>(system.trajectory().size()) /
                                  static_cast<double>(system.stamps_seen());
  summary["resets"] = system.resets();
  summary["visual_restarts"] = system.visual_restarts();
  summary["distance_m"] = system.trajectory().Length();
  if (evaluation) {
    summary["ape_rmse_m"] = evaluation->ape.rmse;
    summary["ape_percent_of_distance"] = evaluation->percent_of_distance.value_or(0.0);
  }
  summary["stages"] = nlohmann::ordered_json::object();
  for (const StageSummary& stage : SummariseStages(record.frames)) {
    summary["stages"][stage.name] = {{"median_ms", stage.median_ms}, {"p99_ms", stage.p99_ms}};
  }
  summary["notices"] = record.notices;
  return summary;
}

std::string Indented(const std::string& text) {
  std::string result = "  ";
  for (size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] == '\n' && i + 1 < text.size()) result += "  ";
  }
  return result;
}

}  // namespace

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  return values[static_cast<size_t>(std::ceil(place))];
}

std::string ResolvedConfiguration(const RunSetup& setup) {
  return "# Everything that this run was made of, resolved.\nversion: " + ProgramVersion() +
         "\nrecording: " + setup.identity.path + "\nframe: " + setup.frame +
         "\nrig_file: " + setup.rig_source + "\noptions:\n" +
         Indented(WritePipeline(setup.pipeline)) + "rig:\n" + Indented(WriteRig(setup.rig));
}

std::vector<StageSummary> SummariseStages(const std::vector<FrameReport>& frames) {
  std::vector<std::pair<std::string, std::vector<double>>> stages;
  std::vector<double> scan_totals;
  std::vector<double> image_totals;
  for (const FrameReport& frame : frames) {
    double total = 0.0;
    for (const StageTime& stage : frame.stages) {
      auto found = std::find_if(stages.begin(), stages.end(),
                                [&](const auto& entry) { return entry.first == stage.name; });
      if (found == stages.end()) found = stages.insert(stages.end(), {stage.name, {}});
      found->second.push_back(stage.milliseconds);
      total += stage.milliseconds;
    }
    (frame.source == FrameSource::kScan ? scan_totals : image_totals).push_back(total);
  }
  stages.emplace_back("total", scan_totals);
  if (!image_totals.empty()) stages.emplace_back("image_total", image_totals);
  std::vector<StageSummary> summaries;
  summaries.reserve(stages.size());
  for (const auto& [name, values] : stages) {
    summaries.push_back({name, Quantile(values, 0.5), Quantile(values, 0.99)});
  }
  return summaries;
}

double MedianTracked(const std::vector<FrameReport>& frames) {
  std::vector<double> tracked;
  for (const FrameReport& frame : frames) {
    if (frame.source == FrameSource::kImage) tracked.push_back(frame.features.tracked);
  }
  return Quantile(tracked, 0.5);
}

std::optional<Evaluation> EvaluateAgainstTruth(const RunSetup& setup, const SlamSystem& system) {
  if (setup.identity.truth_file.empty() || system.trajectory().size() < 3) return std::nullopt;
  try {
    const std::vector<StampedPose> truth = ReadTum(setup.identity.truth_file);
    return EvaluateTrajectory({setup.identity.truth_file, truth},
                              {"trajectory.tum", system.trajectory().poses()}, EvaluationOptions());
  } catch (const std::exception& error) {
    LogWarning(std::string("no error against truth: ") + error.what());
    return std::nullopt;
  }
}

void WriteRunOutputs(const std::string& folder, const RunSetup& setup, const SlamSystem& system,
                     const RunRecord& record, const std::optional<Evaluation>& evaluation) {
  const bool partial = !record.complete;
  WriteTum(folder + "/trajectory.tum", InFrame(system.trajectory(), setup.T_body_frame), partial);
  WriteTum(folder + "/odometry.tum", InFrame(system.odometry(), setup.T_body_frame), partial);
  WritePly(folder + "/map.ply", system.MapPoints(), partial);
  WriteTable(folder + "/timing.csv", TimingTable(record.frames), record.complete);
  WriteTable(folder + "/status.csv", StatusTable(record.frames), record.complete);
  if (system.backend() != nullptr) {
    WriteTable(folder + "/loops.csv", LoopTable(*system.backend()), record.complete);
  }
  const std::string configuration = ResolvedConfiguration(setup);
  WriteFile(folder + "/config.yaml", configuration);
  WriteTable(folder + "/report.html",
             RenderReport(ReportOf(setup, system, record, evaluation), FindPlotly()),
             record.complete);
  // Last, so that a summary that says `complete: true` never stands beside missing files.
  WriteFile(folder + "/summary.json", SummaryOf(setup, system, record, evaluation).dump(2) + "\n");
}

}  // namespace regolith
