// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/sensor/camera_model.h"
#include "regolith/sensor/image.h"
#include "regolith/sim/renderer.h"

namespace regolith {

/// Two images of one place with their true correspondence.
struct ImagePair {
  Image first;
  Image second;
  /// For each pixel of the first image, row by row, its place in the second (pixels; centres at
  /// integer coordinates); NaN for sky, and where the place is hidden or outside.
  std::vector<float> flow_x;
  std::vector<float> flow_y;
  double baseline = 0.0;  ///< m between the cameras
  double rotation = 0.0;  ///< rad between the cameras
  bool same_sun = true;   ///< false: the sun stands elsewhere in the second image
};

/// Fills the correspondence of a pair: the first camera's rays end at places of the scene that the
/// second sees or does not.
void FindFlow(const Scene& scene, const Renderer& renderer, const CameraIntrinsics& intrinsics,
              const SE3& T_world_first, const SE3& T_world_second, ThreadPool* pool,
              ImagePair* pair);

}  // namespace regolith
