// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "regolith/apps/run.h"
#include "regolith/io/recording.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/system/pipeline_options.h"

namespace regolith {

/// Everything that a run is made of, resolved and checked before any long work.
struct RunSetup {
  RecordingIdentity identity;
  RigCalibration rig;
  std::string rig_source;  ///< the file it came from
  PipelineOptions pipeline;
  std::optional<Image> camera_mask;  ///< of the tracked camera, where the rig names one
  std::vector<TopicCut> cuts;
  std::string body;   ///< frame that the estimator follows: "imu", or "lidar" for KITTI
  std::string frame;  ///< frame that the trajectories are given in
  SE3 T_body_frame;
};

/// Throws InputError that names what is missing or wrong.
RunSetup PrepareRun(const RunArguments& arguments);

/// The rig of a recording: --rig, else the one that lies beside it, else the preset of its format
/// with the folder's own calibration. Throws InputError for a bag that has none.
RigCalibration FindRig(const RecordingIdentity& identity, const std::string& rig_file,
                       std::string* source);

}  // namespace regolith
