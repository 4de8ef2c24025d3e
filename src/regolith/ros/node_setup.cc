// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/ros/node_setup.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "regolith/config/feature_setup.h"
#include "regolith/config/install_paths.h"
#include "regolith/config/pipeline_config.h"
#include "regolith/config/rig_config.h"
#include "regolith/config/ros_node_config.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/image_file.h"

namespace regolith {
namespace {

PipelineOptions ResolvePipeline(const std::string& name, const SlamNodeOptions& options,
                                const std::string& settings) {
  YamlDocument document = YamlDocument::FromFile(FindConfig("pipelines", options.pipeline));
  if (!options.config.empty()) document.Overlay(YamlDocument::FromFile(options.config));
  if (!settings.empty()) document.Overlay(YamlDocument::FromText(settings, name + "/settings"));
  if (!options.features.empty()) document.Set("features.frontend=" + options.features);
  return LoadPipeline(document);
}

/// As `regolith run` chooses: of a rig without a mono camera the left one.
void ChooseCamera(NodeSetup* setup) {
  std::string& camera = setup->pipeline.tracked_camera;
  const auto& cameras = setup->rig.cameras;
  if (camera == "mono" && cameras.count("left") > 0 &&
      (setup->pipeline.vio.stereo || cameras.count("mono") == 0)) {
    camera = "left";
  }
}

void PrepareTracking(NodeSetup* setup) {
  if (!TracksImages(setup->pipeline, setup->rig)) return;
  if (setup->options.threads > 0) {
    int& threads = setup->pipeline.features.network.threads;
    threads = std::min(threads, setup->options.threads);
  }
  setup->pipeline.feature_model = PrepareModel(&setup->pipeline.features);
  const CameraCalibration& camera = setup->rig.cameras.at(setup->pipeline.tracked_camera);
  if (camera.mask_file.empty()) return;
  setup->camera_mask = ReadImage(camera.mask_file);
  if (setup->camera_mask->width == camera.intrinsics.width &&
      setup->camera_mask->height == camera.intrinsics.height) {
    return;
  }
  throw InputError(camera.mask_file,
                   "is not as large as the images of camera " + setup->pipeline.tracked_camera);
}

void AwaitFile(const std::string& path, double seconds) {
  constexpr std::chrono::milliseconds kStep(100);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!std::filesystem::exists(path) && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(kStep);
  }
}

bool Reads(const SensorNeeds& needs, const std::string& sensor) {
  if (sensor == "imu") return needs.imu;
  if (sensor == "lidar") return needs.lidar;
  if (sensor == "wheels") return needs.wheels;
  return std::find(needs.cameras.begin(), needs.cameras.end(), sensor) != needs.cameras.end();
}

}  // namespace

NodeSetup ResolveNodeSetup(const std::string& name, const std::string& parameters,
                           const std::string& settings) {
  NodeSetup setup;
  setup.options = LoadSlamNode(YamlDocument::FromText(parameters, name));
  if (setup.options.rig.empty()) {
    throw InputError(name + "/rig",
                     "is not set; expected the file that describes the sensors, "
                     "such as _rig:=rover.yaml (docs/ros.md)");
  }
  AwaitFile(setup.options.rig, setup.options.rig_timeout);
  setup.rig = LoadRig(YamlDocument::FromFile(setup.options.rig));
  setup.pipeline = ResolvePipeline(name, setup.options, settings);
  ChooseCamera(&setup);
  PrepareTracking(&setup);
  if (setup.rig.wheels) setup.T_imu_base = setup.rig.wheels->T_imu_base;
  const SensorNeeds needs = SensorsNeeded(setup.pipeline, setup.rig);
  for (const SensorTopic& sensor : SensorsOf(setup.rig)) {
    if (Reads(needs, sensor.sensor)) setup.topics.push_back(sensor);
  }
  return setup;
}

std::unique_ptr<SlamSystem> MakeSlamSystem(const NodeSetup& setup, ThreadPool* threads) {
  return std::make_unique<SlamSystem>(setup.pipeline, setup.rig, threads, setup.camera_mask);
}

}  // namespace regolith
