// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/pipeline_options.h"

#include "regolith/core/check.h"

namespace regolith {

void PipelineOptions::Check() const {
  REGOLITH_CHECK(visual_velocity_sigma >= 0.0, "visual_velocity_sigma=", visual_velocity_sigma);
  REGOLITH_CHECK(feedback_delay > 0.0, "feedback_delay=", feedback_delay);
  REGOLITH_CHECK(lidar_silence > 0.0, "lidar_silence=", lidar_silence);
  features.Check();
  lio.Check();
  lego_loam.Check();
  vio.Check();
  lidar_depth.Check();
  stereo.Check();
  places.Check();
  visual_loops.Check();
  supervisor.Check();
  backend.Check();
  map.Check();
}

}  // namespace regolith
