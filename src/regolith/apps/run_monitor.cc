// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/run_monitor.h"

#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <utility>

namespace regolith {
namespace {

double ResidentMegabytes() {
  std::ifstream stream("/proc/self/statm");
  double total = 0.0;
  double resident = 0.0;
  stream >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1048576.0;
}

double CpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

RunMonitor::RunMonitor(std::string camera, TimeNs start, TimeNs end)
    : camera_(std::move(camera)), start_(start) {
  const double duration = SecondsBetween(start, end);
  load_step_ = duration > 0.0 ? std::max(0.5, duration / kLoadSamples) : 1.0;
  image_step_ = duration > 0.0 && !camera_.empty() ? duration / kImages : 0.0;
}

void RunMonitor::Observe(const SensorEvent& event) {
  ObserveLoad(EventTime(event));
  if (const auto* frame = std::get_if<CameraFrame>(&event)) ObserveImage(*frame);
}

void RunMonitor::ObserveLoad(TimeNs time) {
  const std::vector<LoadSample>& load = samples_.load;
  if (!load.empty() && SecondsBetween(load.back().time, time) < load_step_) return;
  samples_.load.push_back({time, CpuSeconds(), ResidentMegabytes()});
}

void RunMonitor::ObserveImage(const CameraFrame& frame) {
  if (!(image_step_ > 0.0) || frame.camera != camera_) return;
  if (waiting_) {
    samples_.images.push_back({std::move(*waiting_), frame});
    waiting_.reset();
    return;
  }
  // In the middle of each part of the recording.
  const double due = (static_cast<double>(samples_.images.size()) + 0.5) * image_step_;
  if (SecondsBetween(start_, frame.time) >= due) waiting_ = frame;
}

}  // namespace regolith
