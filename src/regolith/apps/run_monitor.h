// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regolith/sensor/sensor_event.h"

namespace regolith {

/// What the program used up to a moment of the recording.
struct LoadSample {
  TimeNs time = 0;           ///< of the recording
  double cpu_seconds = 0.0;  ///< since the program's start
  double memory_mb = 0.0;    ///< resident
};

/// An image and the next one of the same camera.
struct ImagePair {
  CameraFrame first;
  CameraFrame second;
};

struct RunSamples {
  std::vector<LoadSample> load;
  std::vector<ImagePair> images;
};

/// Watches a run for its report: load and memory now and then, and a few images. It looks at what
/// is read and at the program itself, never at an estimate.
class RunMonitor {
 public:
  static constexpr int kLoadSamples = 240;
  static constexpr int kImages = 8;

  /// `camera` whose images are kept; empty: none. `start` and `end` of the recording; where they
  /// are not known (0), samples are taken every second and no image is kept.
  RunMonitor(std::string camera, TimeNs start, TimeNs end);

  /// After each measurement.
  void Observe(const SensorEvent& event);

  RunSamples TakeSamples() { return std::move(samples_); }

 private:
  void ObserveLoad(TimeNs time);
  void ObserveImage(const CameraFrame& frame);

  std::string camera_;
  TimeNs start_;
  double load_step_;   ///< s
  double image_step_;  ///< s; 0: no images
  std::optional<CameraFrame> waiting_;
  RunSamples samples_;
};

}  // namespace regolith
