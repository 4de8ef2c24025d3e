// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/run.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <thread>
#include <utility>

#include "regolith/apps/output_folder.h"
#include "regolith/apps/progress.h"
#include "regolith/apps/run_monitor.h"
#include "regolith/apps/run_outputs.h"
#include "regolith/apps/run_report.h"
#include "regolith/apps/run_setup.h"
#include "regolith/core/log.h"
#include "regolith/core/stop.h"
#include "regolith/core/thread_pool.h"

namespace regolith {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kInterrupted = 130;
constexpr double kStartTime = 2.0;  // s

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double ProcessorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double PeakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Holds measurements back until they are due, so that a recording runs at a pace.
class Pacer {
 public:
  explicit Pacer(double rate) : rate_(rate) {}

  bool has_pace() const { return rate_ > 0.0; }

  void Wait(TimeNs time) {
    if (!has_pace()) return;
    if (first_ == 0) first_ = time;
    std::this_thread::sleep_until(Due(time));
  }

  Clock::time_point Due(TimeNs time) const {
    return start_ + std::chrono::duration_cast<Clock::duration>(
                        std::chrono::duration<double>(SecondsBetween(first_, time) / rate_));
  }

 private:
  double rate_;
  TimeNs first_ = 0;
  Clock::time_point start_ = Clock::now();
};

void Keep(std::vector<FrameReport> reports, RunRecord* record) {
  for (FrameReport& report : reports) record->frames.push_back(std::move(report));
}

/// Of all frames with a pose: from when the last of what it is made of was due. Those of the start,
/// which wait for the IMU's first second, are left out.
std::vector<double> Latencies(const std::vector<FrameReport>& frames, const Pacer& pacer) {
  std::vector<double> latencies;
  for (const FrameReport& frame : frames) {
    const bool has_pose = frame.source == FrameSource::kScan ? frame.has_scan
                          : frame.stereo ? frame.stereo->T_world_camera.has_value()
                                         : frame.visual.has_value();
    if (!has_pose || SecondsBetween(frames.front().end, frame.end) < kStartTime) continue;
    const std::chrono::duration<double, std::milli> late = frame.completed - pacer.Due(frame.end);
    latencies.push_back(late.count());
  }
  return latencies;
}

/// Feeds the recording to the system until its end or a request to stop. A failure in the middle is
/// kept in `failure`, so that what was estimated before it can be written.
RunRecord Estimate(SensorSource& source, double rate, bool quiet, SlamSystem& system,
                   RunMonitor monitor, std::exception_ptr* failure) {
  RunRecord record;
  Progress progress("run", SecondsBetween(source.start_time(), source.end_time()), quiet);
  Pacer pacer(rate);
  const Clock::time_point start = Clock::now();
  const double processor_start = ProcessorSeconds();
  TimeNs first = 0;
  TimeNs last = 0;
  try {
    for (auto event = source.Next(); event; event = source.Next()) {
      if (StopRequested()) {
        record.complete = false;
        break;
      }
      last = EventTime(*event);
      if (first == 0) first = last;
      pacer.Wait(last);
      monitor.Observe(*event);
      Keep(system.Process(std::move(*event)), &record);
      progress.Update(SecondsBetween(first, last));
    }
    Keep(record.complete ? system.Finish() : system.Settle(), &record);
  } catch (...) {
    record.complete = false;
    *failure = std::current_exception();
    Keep(system.Settle(), &record);
  }
  if (pacer.has_pace()) record.latencies = Latencies(record.frames, pacer);
  record.samples = monitor.TakeSamples();
  record.recording_seconds = SecondsBetween(first, last);
  record.wall_seconds = SecondsSince(start);
  record.cpu_seconds = ProcessorSeconds() - processor_start;
  record.notices = source.Notices();
  for (const std::string& notice : system.Notices()) record.notices.push_back(notice);
  return record;
}

/// Sensors of the rig that this pipeline leaves aside, as a line for the user; empty where it uses
/// all.
std::string UnusedSensors(const RunSetup& setup, const SensorNeeds& needs) {
  std::string unused;
  const auto add = [&](const std::string& name) { unused += (unused.empty() ? "" : ", ") + name; };
  if (setup.rig.imu && !needs.imu) add("imu");
  for (const auto& [name, camera] : setup.rig.cameras) {
    const auto& used = needs.cameras;
    if (std::find(used.begin(), used.end(), name) == used.end()) add("camera " + name);
  }
  if (setup.rig.wheels && !needs.wheels) add("wheels");
  if (unused.empty()) return "";
  return "pipeline " + setup.pipeline.name + " does not use: " + unused;
}

void PrintResult(const RunArguments& arguments, const RunSetup& setup, const SlamSystem& system,
                 const RunRecord& record, const std::optional<Evaluation>& evaluation) {
  std::printf("poses             %zu of %zu %s\n", system.trajectory().size(), system.stamps_seen(),
              system.scans_seen() > 0 ? "scans" : "images");
  std::printf("distance          %.2f m\n", system.trajectory().Length());
  if (evaluation) {
    std::printf("APE RMSE          %.3f m (%.2f %% of the distance)\n", evaluation->ape.rmse,
                evaluation->percent_of_distance.value_or(0.0));
  }
  if (system.images_seen() > 0) {
    std::printf("images            %zu, %.0f features tracked in the median (%s)\n",
                system.images_seen(), MedianTracked(record.frames),
                setup.pipeline.features.frontend.c_str());
  }
  std::printf("real-time factor  %.1f\n",
              record.wall_seconds > 0.0 ? record.recording_seconds / record.wall_seconds : 0.0);
  std::printf("report            %s/report%s.html\n", arguments.out.c_str(),
              record.complete ? "" : ".partial");
}

}  // namespace

int Run(const RunArguments& arguments) {
  const RunSetup setup = PrepareRun(arguments);
  ThreadPool threads(arguments.threads);
  SlamSystem system(setup.pipeline, setup.rig, &threads, setup.camera_mask);
  ReadOptions read;
  read.imu = system.needs().imu;
  read.lidar = system.needs().lidar;
  read.wheels = system.needs().wheels;
  read.cameras = system.needs().cameras;
  read.skip_absent_cameras = system.needs().may_lack_cameras;
  read.skip_absent_wheels = system.needs().may_lack_wheels;
  read.cuts = setup.cuts;
  const auto source = OpenRecording(setup.identity, setup.rig, read);
  PrepareOutputFolder(arguments.out, arguments.overwrite);

  std::exception_ptr failure;
  const bool tracks = TracksImages(setup.pipeline, setup.rig);
  RunMonitor monitor(tracks ? setup.pipeline.tracked_camera : "", source->start_time(),
                     source->end_time());
  RunRecord record =
      Estimate(*source, arguments.rate, arguments.quiet, system, std::move(monitor), &failure);
  record.peak_rss_mb = PeakMegabytes();
  const std::string unused = UnusedSensors(setup, system.needs());
  if (!unused.empty()) record.notices.push_back(unused);
  for (const std::string& notice : record.notices) LogWarning(notice);
  const std::optional<Evaluation> evaluation = EvaluateAgainstTruth(setup, system);
  if (!failure || !record.frames.empty()) {
    WriteRunOutputs(arguments.out, setup, system, record, evaluation);
  }
  if (failure) std::rethrow_exception(failure);
  PrintResult(arguments, setup, system, record, evaluation);
  if (!record.complete)
    LogWarning("interrupted: the results so far are in files named *.partial.*");
  return record.complete ? 0 : kInterrupted;
}

}  // namespace regolith
