// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "regolith/lio/lidar_odometry.h"
#include "synthetic_drive.h"

namespace regolith {
namespace {

RigCalibration Rig() {
  RigCalibration rig;
  rig.gravity = kSyntheticGravity;
  rig.imu.emplace();
  rig.lidar.emplace();
  return rig;
}

/// A drive of 40 scans of 13 000 points with an IMU of 200 Hz; `s_per_scan` is the mean.
void LidarOdometryDrive(benchmark::State& state) {
  constexpr int kScans = 40;
  constexpr int kSamplesPerScan = 20;
  for (int i = 0; i < kScans; ++i) SyntheticScan(i);
  ThreadPool threads(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    LidarOdometry odometry(LidarOdometryOptions(), Rig(), &threads);
    size_t estimates = 0;
    for (int i = 0; i < kScans * kSamplesPerScan; ++i) {
      estimates += odometry.AddImu(SyntheticImu(0.005 * i)).size();
      if (i % kSamplesPerScan == 0) {
        estimates += odometry.AddScan(SyntheticScan(i / kSamplesPerScan)).size();
      }
    }
    estimates += odometry.Finish().size();
    if (estimates != kScans) state.SkipWithError("scans were lost");
  }
  state.counters["s_per_scan"] = benchmark::Counter(
      kScans, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(LidarOdometryDrive)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace regolith
