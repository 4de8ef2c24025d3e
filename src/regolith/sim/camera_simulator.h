// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/thread_pool.h"
#include "regolith/sensor/image.h"
#include "regolith/sim/renderer.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// How long a sensor is exposed and how much its signal is amplified.
struct Exposure {
  double time = 0.01;  ///< s
  double gain = 1.0;
};

/// Automatic exposure: each frame moves half of the way (in stops) to what the frame before would
/// have needed.
class ExposureControl {
 public:
  explicit ExposureControl(const CameraOptions& options) : options_(options) {}

  /// For the next frame, whose scene looks like `view`; the first frame gets what it needs.
  Exposure Next(const RenderedView& view);

 private:
  double Needed(const RenderedView& view) const;

  CameraOptions options_;
  double current_ = 0.0;  ///< time · gain, s; 0 before the first frame
  double needed_ = 0.0;   ///< of the frame before
};

/// How fast a camera moves during an exposure.
struct CameraMotion {
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();          ///< m/s, camera frame
  Eigen::Vector3f angular_velocity = Eigen::Vector3f::Zero();  ///< rad/s, camera frame
};

/// From radiance to eight bits: motion blur, the lens' blur, vignetting, shot and read noise.
class CameraSimulator {
 public:
  CameraSimulator(const CameraOptions& options, const Renderer& renderer, ThreadPool* pool);

  /// Noise depends on `seed` and `frame` alone.
  Image Expose(const RenderedView& view, const CameraMotion& motion, const Exposure& exposure,
               uint64_t seed, uint64_t frame) const;

 private:
  std::vector<float> BlurByMotion(const RenderedView& view, const CameraMotion& motion,
                                  double time) const;
  void BlurByLens(std::vector<float>* radiance) const;
  Eigen::Vector2f PixelMotion(const CameraMotion& motion, float distance, int column,
                              int row) const;

  CameraOptions options_;
  const Renderer& renderer_;
  ThreadPool* pool_;
  float focal_;                  ///< pixels
  std::vector<float> vignette_;  ///< by pixel
};

}  // namespace regolith
