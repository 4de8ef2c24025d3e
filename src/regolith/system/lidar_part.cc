// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/lidar_part.h"

#include <utility>

#include "regolith/lio/lego_loam.h"
#include "regolith/lio/lidar_odometry.h"

namespace regolith {
namespace {

constexpr double kPeriod = 0.1;  // s, of poses where the rig has no lidar

std::unique_ptr<ScanOdometry> MakeOdometry(const PipelineOptions& options,
                                           const RigCalibration& rig, ThreadPool* threads) {
  if (options.odometry == OdometryKind::kLegoLoam) {
    return std::make_unique<LegoLoam>(options.lego_loam, rig, threads);
  }
  return std::make_unique<LidarOdometry>(options.lio, rig, threads);
}

FrameReport ReportOf(const ScanEstimate& estimate) {
  FrameReport report;
  report.stamp = estimate.stamp;
  report.has_scan = estimate.has_scan;
  report.end = estimate.inertial ? estimate.inertial->state.time : estimate.stamp;
  report.T_world_body = estimate.T_world_body;
  report.leader = estimate.leader;
  report.at_rest = estimate.at_rest;
  report.points = static_cast<int>(estimate.points.size());
  report.matches = estimate.match.system.matches;
  report.inliers = estimate.match.system.inliers;
  report.residual_scale = estimate.match.system.scale;
  report.degenerate_directions = estimate.match.observable.degenerate_directions;
  report.weakest_ratio = estimate.match.observable.weakest_ratio;
  report.weakest_position = estimate.match.observable.weakest_position;
  report.covariance = estimate.covariance;
  report.stages = estimate.stages;
  return report;
}

}  // namespace

LidarPart::LidarPart(const PipelineOptions& options, const RigCalibration& rig, ThreadPool* threads,
                     KeyframeSink keyframes)
    : odometry_(MakeOdometry(options, rig, threads)),
      keyframes_(std::move(keyframes)),
      selector_(options.backend.keyframes),
      map_(options.map),
      period_(rig.lidar ? rig.lidar->period : kPeriod),
      silence_(options.lidar_silence) {}

std::vector<FrameReport> LidarPart::Process(const SensorEvent& event) {
  std::vector<FrameReport> reports = BridgeSilence(EventTime(event));
  const auto take = [&](std::vector<ScanEstimate> estimates) {
    for (FrameReport& report : Report(std::move(estimates))) reports.push_back(std::move(report));
  };
  if (const auto* sample = std::get_if<ImuSample>(&event)) {
    take(odometry_->AddImu(*sample));
  } else if (const auto* wheels = std::get_if<WheelOdometry>(&event)) {
    take(odometry_->AddWheels(*wheels));
  } else if (const auto* scan = std::get_if<LidarScan>(&event)) {
    ++scans_;
    last_stamp_ = scan->stamp;
    take(odometry_->AddScan(*scan));
  } else if (const auto* frame = std::get_if<CameraFrame>(&event)) {
    if (sights_) sights_->AddImage(*frame);
  }
  return reports;
}

std::vector<FrameReport> LidarPart::Finish() { return Report(odometry_->Finish()); }

/// Poses are asked for as late as a scan may be late, so that one that does come is not overtaken.
std::vector<FrameReport> LidarPart::BridgeSilence(TimeNs now) {
  std::vector<FrameReport> reports;
  if (!last_stamp_) last_stamp_ = now;
  while (SecondsBetween(*last_stamp_, now) > silence_) {
    last_stamp_ = AddSeconds(*last_stamp_, period_);
    for (FrameReport& report : Report(odometry_->AddStamp(*last_stamp_))) {
      reports.push_back(std::move(report));
    }
  }
  return reports;
}

std::vector<FrameReport> LidarPart::Report(std::vector<ScanEstimate> estimates) {
  std::vector<FrameReport> reports;
  for (ScanEstimate& made : estimates) {
    estimates_.push_back(std::make_shared<const ScanEstimate>(std::move(made)));
    const ScanEstimate& estimate = *estimates_.back();
    if (sights_) sights_->AddEstimate(estimates_.back());
    Stopwatch stopwatch;
    if (!estimate.has_scan) ++asked_;
    trajectory_.Append({estimate.stamp, estimate.T_world_body});
    map_.Add(estimate.points, static_cast<uint32_t>(trajectory_.size() - 1));
    stopwatch.Lap("output_map");
    reports.push_back(ReportOf(estimate));
    FrameReport& report = reports.back();
    for (const StageTime& stage : stopwatch.stages()) report.stages.push_back(stage);
    report.keyframe = SendKeyframe(estimate);
    report.completed = std::chrono::steady_clock::now();
  }
  return reports;
}

std::optional<size_t> LidarPart::SendKeyframe(const ScanEstimate& estimate) {
  if (!keyframes_ || !selector_.Select(estimate.stamp, estimate.T_world_body)) return std::nullopt;
  KeyframeInput keyframe;
  keyframe.time = estimate.stamp;
  keyframe.T_odom_body = estimate.T_world_body;
  keyframe.covariance = estimate.covariance;
  keyframe.is_level = estimate.inertial.has_value();
  const SE3 T_body_world = estimate.T_world_body.Inverse();
  keyframe.points_body.reserve(estimate.points.size());
  for (const MapPoint& point : estimate.points) {
    keyframe.points_body.push_back(T_body_world * point.position.cast<double>());
  }
  keyframes_(std::move(keyframe), sights_ ? sights_->Take() : std::nullopt);
  return keyframe_count_++;
}

std::vector<std::string> LidarPart::Notices() const {
  std::vector<std::string> notices = odometry_->Notices();
  if (asked_ > 0) {
    notices.push_back(Concatenate("no scans for ", period_ * static_cast<double>(asked_),
                                  " s in all: ", asked_,
                                  " poses are made of the other sensors alone"));
  }
  return notices;
}

}  // namespace regolith
