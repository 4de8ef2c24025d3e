// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/run_setup.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "regolith/config/feature_setup.h"
#include "regolith/config/install_paths.h"
#include "regolith/config/pipeline_config.h"
#include "regolith/config/rig_config.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/image_file.h"
#include "regolith/system/slam_system.h"

namespace regolith {
namespace {

PipelineOptions ResolvePipeline(const RunArguments& arguments) {
  YamlDocument document = YamlDocument::FromFile(FindConfig("pipelines", arguments.pipeline));
  if (!arguments.config.empty()) document.Overlay(YamlDocument::FromFile(arguments.config));
  for (const std::string& assignment : arguments.set) document.Set(assignment);
  if (!arguments.features.empty()) document.Set("features.frontend=" + arguments.features);
  return LoadPipeline(document);
}

/// The model and the mask of the camera whose images are tracked, if any are.
void PrepareTracking(const RunArguments& arguments, RunSetup* setup) {
  PipelineOptions& pipeline = setup->pipeline;
  if (!TracksImages(pipeline, setup->rig)) {
    if (arguments.features.empty()) return;
    throw InputError("--features " + arguments.features,
                     pipeline.tracked_camera.empty()
                         ? "pipeline " + pipeline.name +
                               " tracks no images; name a camera by --set tracked_camera=NAME"
                         : "the rig has no camera `" + pipeline.tracked_camera +
                               "`; name one by --set tracked_camera=NAME");
  }
  // --threads bounds the whole run; results do not depend on how many threads infer.
  if (arguments.threads > 0) {
    int& threads = pipeline.features.network.threads;
    threads = std::min(threads, arguments.threads);
  }
  pipeline.feature_model = PrepareModel(&pipeline.features);
  const CameraCalibration& camera = setup->rig.cameras.at(pipeline.tracked_camera);
  if (camera.mask_file.empty()) return;
  setup->camera_mask = ReadImage(camera.mask_file);
  const Image& mask = *setup->camera_mask;
  const CameraIntrinsics& intrinsics = camera.intrinsics;
  if (mask.width == intrinsics.width && mask.height == intrinsics.height) return;
  throw InputError(camera.mask_file,
                   Concatenate("is ", mask.width, " × ", mask.height, ", but camera ",
                               pipeline.tracked_camera, " is ", intrinsics.width, " × ",
                               intrinsics.height, "; expected a mask as large as its images"));
}

double ParseSeconds(const std::string& text, const std::string& drop) {
  char* end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(seconds)) {
    throw InputError("--drop " + drop, "expected TOPIC:START:END, with seconds from the start");
  }
  return seconds;
}

TopicCut ParseDrop(const std::string& drop) {
  const size_t last = drop.rfind(':');
  const size_t first = last == std::string::npos || last == 0 ? last : drop.rfind(':', last - 1);
  if (first == std::string::npos || first == 0) {
    throw InputError("--drop " + drop, "expected TOPIC:START:END, such as /velodyne_points:10:15");
  }
  TopicCut cut{drop.substr(0, first), ParseSeconds(drop.substr(first + 1, last - first - 1), drop),
               ParseSeconds(drop.substr(last + 1), drop)};
  if (cut.end <= cut.start) throw InputError("--drop " + drop, "ends before it starts");
  return cut;
}

// T_body_frame of a frame that --frame names; the body is `imu`, which the rig's extrinsics start
// from.
SE3 FrameInBody(const std::string& frame, const RigCalibration& rig) {
  if (frame == "imu") return SE3();
  if (frame == "lidar" && rig.lidar) return rig.lidar->T_imu_lidar;
  if (frame == "base" && rig.wheels) return rig.wheels->T_imu_base;
  if (frame == "camera" && !rig.cameras.empty()) {
    for (const char* name : {"mono", "left"}) {
      const auto camera = rig.cameras.find(name);
      if (camera != rig.cameras.end()) return camera->second.T_imu_camera;
    }
    return rig.cameras.begin()->second.T_imu_camera;
  }
  if (frame == "lidar" || frame == "base" || frame == "camera") {
    throw InputError("--frame " + frame, "the rig has no such sensor");
  }
  throw InputError("--frame " + frame, "expected imu, lidar, camera or base");
}

}  // namespace

RigCalibration FindRig(const RecordingIdentity& identity, const std::string& rig_file,
                       std::string* source) {
  *source = !rig_file.empty() ? rig_file : identity.rig_file;
  if (!source->empty()) return LoadRig(YamlDocument::FromFile(*source));
  if (identity.preset_rig.empty()) {
    throw InputError(identity.path,
                     "the recording has no rig.yaml beside it; name one by --rig FILE "
                     "(examples: config/rigs, README)");
  }
  *source = FindConfig("rigs", identity.preset_rig);
  RigCalibration rig = LoadRig(YamlDocument::FromFile(*source));
  ApplyFolderCalibration(identity, &rig);
  rig.Check();
  return rig;
}

RunSetup PrepareRun(const RunArguments& arguments) {
  RunSetup setup;
  setup.identity = IdentifyRecording(arguments.recording);
  setup.pipeline = ResolvePipeline(arguments);
  setup.rig = FindRig(setup.identity, arguments.rig, &setup.rig_source);
  // Of a stereo pair, or where the rig has nothing else, the left eye is the camera.
  std::string& camera = setup.pipeline.tracked_camera;
  const bool has_left = setup.rig.cameras.count("left") > 0;
  if (camera == "mono" && has_left &&
      (setup.pipeline.vio.stereo || setup.rig.cameras.count("mono") == 0)) {
    camera = "left";
  }
  PrepareTracking(arguments, &setup);
  for (const std::string& drop : arguments.drops) setup.cuts.push_back(ParseDrop(drop));
  const bool kitti = setup.identity.format == RecordingFormat::kKittiRaw ||
                     setup.identity.format == RecordingFormat::kKittiOdometry;
  setup.body = kitti ? "lidar" : "imu";
  setup.frame = arguments.frame.empty() ? setup.body : arguments.frame;
  setup.T_body_frame = FrameInBody(setup.frame, setup.rig);
  if (!std::isfinite(arguments.rate) || arguments.rate < 0.0) {
    throw InputError("--rate", Concatenate(arguments.rate, "; expected a factor above 0"));
  }
  return setup;
}

}  // namespace regolith
