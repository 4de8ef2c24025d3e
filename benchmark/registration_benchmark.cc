// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "regolith/registration/point_to_plane.h"
#include "synthetic_drive.h"

namespace regolith {
namespace {

std::vector<VoxelMap> Maps() {
  std::vector<VoxelMap> maps;
  VoxelMapOptions options;
  for (int level = 0; level < 2; ++level, options.voxel_size *= 3.0) {
    maps.emplace_back(options).Add(SyntheticMap(10), Eigen::Vector3d::Zero());
  }
  return maps;
}

/// All 13 000 points of a scan against a map of ten; the argument is the number of threads.
void SearchPlanes(benchmark::State& state) {
  const auto maps = Maps();
  const auto points = Positions(SyntheticScan(0));
  ThreadPool threads(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    std::vector<PlaneMatch> planes;
    FindPlanes(points, SyntheticPose(0.0), maps, PointToPlaneOptions(), &threads, &planes);
    benchmark::DoNotOptimize(planes);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(points.size()));
}
BENCHMARK(SearchPlanes)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void Linearise(benchmark::State& state) {
  const auto maps = Maps();
  const auto points = Positions(SyntheticScan(0));
  const SE3 pose = SyntheticPose(0.0);
  ThreadPool threads(1);
  std::vector<PlaneMatch> planes;
  FindPlanes(points, pose, maps, PointToPlaneOptions(), &threads, &planes);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        LinearizePointToPlane(points, planes, pose, PointToPlaneOptions(), &threads));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(points.size()));
}
BENCHMARK(Linearise)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace regolith
