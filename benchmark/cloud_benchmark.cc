// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "regolith/cloud/voxel_map.h"
#include "synthetic_drive.h"

namespace regolith {
namespace {

/// A scan into an empty map: every voxel is new.
void VoxelMapAddToEmpty(benchmark::State& state) {
  const auto points = SyntheticMap(1);
  for (auto _ : state) {
    VoxelMap map{VoxelMapOptions()};
    map.Add(points, Eigen::Vector3d::Zero());
    benchmark::DoNotOptimize(map.voxel_count());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(points.size()));
}
BENCHMARK(VoxelMapAddToEmpty)->Unit(benchmark::kMillisecond);

/// A scan of ground that the map knows: most voxels are full.
void VoxelMapAddToKnown(benchmark::State& state) {
  const auto known = SyntheticMap(20);
  const auto points = SyntheticMap(1);
  VoxelMap map{VoxelMapOptions()};
  map.Add(known, Eigen::Vector3d::Zero());
  for (auto _ : state) map.Add(points, Eigen::Vector3d::Zero());
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(points.size()));
}
BENCHMARK(VoxelMapAddToKnown)->Unit(benchmark::kMillisecond);

void VoxelMapNearest(benchmark::State& state) {
  const auto known = SyntheticMap(20);
  const auto queries = SyntheticMap(1);
  VoxelMap map{VoxelMapOptions()};
  map.Add(known, Eigen::Vector3d::Zero());
  for (auto _ : state) {
    for (const Eigen::Vector3d& query : queries) {
      benchmark::DoNotOptimize(map.Nearest(query, 8, map.voxel_size()));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(queries.size()));
}
BENCHMARK(VoxelMapNearest)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace regolith
