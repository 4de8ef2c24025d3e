// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <vector>

#include "regolith/imu/preintegration.h"
#include "synthetic_drive.h"

namespace regolith {
namespace {

/// One second at 200 Hz, with covariance and bias Jacobians.
void PreintegrateOneSecond(benchmark::State& state) {
  std::vector<ImuSample> samples;
  for (int i = 0; i <= 200; ++i) samples.push_back(SyntheticImu(0.005 * i));
  for (auto _ : state) {
    ImuPreintegration motion(ImuNoise(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    motion.Integrate(samples);
    benchmark::DoNotOptimize(motion.delta_position());
  }
  state.SetItemsProcessed(state.iterations() * 200);
}
BENCHMARK(PreintegrateOneSecond)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace regolith
