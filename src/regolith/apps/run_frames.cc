// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/run_frames.h"

#include <cstdio>
#include <memory>

#include "regolith/features/feature_frontend.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/system/slam_system.h"

namespace regolith {
namespace {

ReportFrame FrameOf(const ImagePair& pair, const PairMatches& matches, TimeNs start) {
  const Image& image = pair.first.image;
  ReportFrame frame;
  frame.seconds = SecondsBetween(start, pair.first.time);
  frame.width = image.width;
  frame.height = image.height;
  frame.grey = image.data;
  for (size_t i = 0; i < matches.matches.size(); ++i) {
    if (matches.inliers[i] == 0) continue;
    const FeatureMatch& match = matches.matches[i];
    frame.features.push_back({matches.first.pixels[static_cast<size_t>(match.first)],
                              matches.second.pixels[static_cast<size_t>(match.second)]});
  }
  char caption[120];
  std::snprintf(caption, sizeof caption, "%.1f s: %zu features, lines to their place %.1f s later",
                frame.seconds, frame.features.size(),
                SecondsBetween(pair.first.time, pair.second.time));
  frame.caption = caption;
  return frame;
}

}  // namespace

std::vector<ReportFrame> SampleFrames(const RunSetup& setup, const std::vector<ImagePair>& images,
                                      TimeNs start) {
  std::vector<ReportFrame> frames;
  if (images.empty() || !TracksImages(setup.pipeline, setup.rig)) return frames;
  const CameraCalibration& camera = setup.rig.cameras.at(setup.pipeline.tracked_camera);
  const std::unique_ptr<CameraModel> model = CameraModel::Create(camera.intrinsics);
  const auto frontend =
      FeatureFrontend::Create(setup.pipeline.features, model.get(), setup.pipeline.feature_model);
  for (const ImagePair& pair : images) {
    frames.push_back(
        FrameOf(pair, frontend->MatchPair(pair.first.image, pair.second.image), start));
  }
  return frames;
}

}  // namespace regolith
