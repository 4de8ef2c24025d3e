// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a simulated second costs: 30 images, 10 scans, and the tiles of ground of half a metre.
#include <benchmark/benchmark.h>

#include <memory>

#include "regolith/core/thread_pool.h"
#include "regolith/sim/camera_simulator.h"
#include "regolith/sim/drive.h"
#include "regolith/sim/fill_light.h"
#include "regolith/sim/lidar_simulator.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/scene.h"
#include "regolith/sim/sunlight.h"

namespace regolith {
namespace {

// A straight drive of ten metres over a mare.
struct World {
  World()
      : pool(1),
        surface(CreateGeneratedSurface(
            options.terrain, 1, {Eigen::Vector2d(-60.0, -60.0), Eigen::Vector2d(60.0, 60.0)})),
        motion(*surface, StraightPath(), options.rover, options.vibration, 1),
        ground(*surface, motion.origin()),
        photometry(options.planet, options.sun, options.terrain.albedo.mean) {
    for (double x = 0.0; x <= 10.0; x += 0.25) places.emplace_back(x, 0.0);
    scene = Scene::Create(ground, places, RocksAroundPath(*surface, places), photometry,
                          options.mesh, &pool);
    renderer =
        std::make_unique<Renderer>(MakeIntrinsics(options.camera), *scene, photometry, &pool);
    T_world_camera =
        motion.PoseAt(1.0) * BaseFromImu().Inverse() * BaseFromCamera(options.camera, "mono");
    rover =
        std::make_unique<RoverShadow>(RoverBody(), motion.PoseAt(1.0) * BaseFromImu().Inverse());
  }

  static std::vector<PlanarPose> StraightPath() {
    std::vector<PlanarPose> path;
    for (int i = 0; i < 200; ++i) path.push_back({{0.05 * i, 0.0}, 0.0, 0.5});
    return path;
  }

  ScenarioOptions options;
  ThreadPool pool;
  std::unique_ptr<Surface> surface;
  RoverMotion motion;
  Ground ground;
  Photometry photometry;
  std::vector<Eigen::Vector2d> places;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Renderer> renderer;
  std::unique_ptr<RoverShadow> rover;
  SE3 T_world_camera;
};

World& TheWorld() {
  static World world;
  return world;
}

void SampleTile(benchmark::State& state) {
  World& world = TheWorld();
  for (auto _ : state) {
    GroundTile tile(world.ground, {3.2, 0.64}, 0.005);
    benchmark::DoNotOptimize(tile.spacing());
  }
}
BENCHMARK(SampleTile)->Unit(benchmark::kMillisecond);

void SunlightOnTile(benchmark::State& state) {
  World& world = TheWorld();
  const GroundTile tile(world.ground, {0.64, 0.0}, 0.005);
  for (auto _ : state) {
    benchmark::DoNotOptimize(CastSunlightOnTile(*world.scene, world.photometry.sun(), tile));
  }
}
BENCHMARK(SunlightOnTile)->Unit(benchmark::kMillisecond);

void FillLightOnTile(benchmark::State& state) {
  World& world = TheWorld();
  const GroundTile tile(world.ground, {0.64, 0.0}, 0.005);
  for (auto _ : state)
    benchmark::DoNotOptimize(CastFillLight(*world.scene, world.photometry, true, tile));
}
BENCHMARK(FillLightOnTile)->Unit(benchmark::kMillisecond);

// Half a metre on: what a second of driving makes new.
void MoveHalfAMetre(benchmark::State& state) {
  World& world = TheWorld();
  double x = 0.0;
  for (auto _ : state) {
    x = x > 9.0 ? 0.0 : x + 0.5;
    world.scene->MoveTo({x, 0.0});
  }
  world.scene->MoveTo({0.0, 0.0});
}
BENCHMARK(MoveHalfAMetre)->Unit(benchmark::kMillisecond)->Iterations(16);

void RenderImage(benchmark::State& state) {
  World& world = TheWorld();
  RenderedView view;
  for (auto _ : state) {
    world.renderer->Render(world.T_world_camera, {world.rover.get(), Lamp{}}, &view);
  }
}
BENCHMARK(RenderImage)->Unit(benchmark::kMillisecond);

void ExposeImage(benchmark::State& state) {
  World& world = TheWorld();
  const CameraSimulator camera(world.options.camera, *world.renderer, &world.pool);
  RenderedView view;
  world.renderer->Render(world.T_world_camera, {world.rover.get(), Lamp{}}, &view);
  CameraMotion motion;
  motion.velocity = {0.0F, 0.0F, 0.5F};
  uint64_t frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera.Expose(view, motion, {0.012, 1.0}, 1, frame++));
  }
}
BENCHMARK(ExposeImage)->Unit(benchmark::kMillisecond);

void LidarTurn(benchmark::State& state) {
  World& world = TheWorld();
  const LidarSimulator lidar(world.options.lidar, *world.scene, world.motion, 1, &world.pool);
  uint64_t scan = 0;
  for (auto _ : state) benchmark::DoNotOptimize(lidar.Scan(1.0, scan++));
}
BENCHMARK(LidarTurn)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace regolith
