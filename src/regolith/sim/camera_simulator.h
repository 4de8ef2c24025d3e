// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/thread_pool.h"
#include "regolith/geometry/se3.h"
#include "regolith/sensor/image.h"
#include "regolith/sim/photometry.h"
#include "regolith/sim/row_caster.h"
#include "regolith/sim/scenario_options.h"
#include "regolith/sim/terrain_mesh.h"

namespace regolith {

/// Renders what a camera sees: ground under the sun with shadows, then exposure, vignetting, shot
/// and read noise and eight bits. An exposure is one instant: there is no motion blur yet.
class CameraSimulator {
 public:
  CameraSimulator(const CameraOptions& options, const TerrainMesh& mesh,
                  const Photometry& photometry, ThreadPool* pool);

  /// The image of a camera at `T_world_camera`. Noise depends on `seed` and `frame` alone.
  Image Render(const SE3& T_world_camera, uint64_t seed, uint64_t frame);

  /// Seconds that the last image was exposed.
  double last_exposure() const { return last_exposure_; }

 private:
  struct View;

  void RenderRows(const View& view, int begin, int end);
  void RenderNear(const View& view, int begin, int end);
  void RenderFar(const View& view, int begin, int end);
  bool SeesFar(const View& view, int row) const;
  /// The rays of a line, `shift` lines lower; CastRow casts them too.
  RayRow MakeRow(const View& view, int row, float shift) const;
  RayRow CastRow(const View& view, int row) const;
  std::vector<float> Radiance(const View& view, const RayRow& rays) const;
  void AddRadiance(const std::vector<float>& radiance, float weight, int row);
  double ChooseExposure() const;
  Image Expose(uint64_t noise_seed, double exposure) const;

  CameraOptions options_;
  const TerrainMesh& mesh_;
  const Photometry& photometry_;
  ThreadPool* pool_;
  std::vector<Eigen::Vector3f> bearings_;  ///< camera frame, by pixel
  std::vector<float> vignette_;            ///< by pixel
  std::vector<float> radiance_;            ///< I/F, by pixel
  double last_exposure_ = 0.0;
};

}  // namespace regolith
