// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/core/thread_pool.h"
#include "regolith/geometry/se3.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sim/lamp.h"
#include "regolith/sim/photometry.h"
#include "regolith/sim/rover_shadow.h"
#include "regolith/sim/scene.h"

namespace regolith {

/// What a camera sees in an instant, before optics and sensor; row by row.
struct RenderedView {
  int width = 0;
  int height = 0;
  std::vector<float> radiance;  ///< I/F
  std::vector<float> distance;  ///< m along the pixel's ray; infinite for sky
};

/// What stands beside the ground and changes from frame to frame.
struct Surroundings {
  const RoverShadow* rover = nullptr;  ///< none where null
  Lamp lamp;
};

/// Casts the rays of a camera: one a pixel, and four where the pixel's footprint is much finer than
/// what it sees or where an edge crosses it.
class Renderer {
 public:
  Renderer(const CameraIntrinsics& intrinsics, const Scene& scene, const Photometry& photometry,
           ThreadPool* pool);

  void Render(const SE3& T_world_camera, const Surroundings& surroundings,
              RenderedView* view) const;

  /// The unit vector of a pixel in the camera's frame.
  const Eigen::Vector3f& bearing(int column, int row) const {
    return bearings_[static_cast<size_t>(row * width_ + column)];
  }

 private:
  struct Pose {
    Eigen::Matrix3f R_world_camera;
    Eigen::Vector3f origin;  // m, world
  };
  // A ray on its way to a pixel.
  struct Sample {
    Eigen::Vector3f direction;  // world
    int column;
  };

  void RenderRow(const Pose& pose, const Surroundings& surroundings, int row, RenderedView* view,
                 std::vector<uint32_t>* objects) const;
  void RefineRow(const Pose& pose, const Surroundings& surroundings, int row,
                 const std::vector<uint32_t>& objects, const std::vector<float>& distances,
                 RenderedView* view) const;
  bool NeedsMore(const std::vector<uint32_t>& objects, const std::vector<float>& distances,
                 int column, int row) const;
  Eigen::Vector3f Between(int column, int row, float right, float down) const;
  void Shade(const RayPacket& rays, int count, float pixel, const Surroundings& surroundings,
             float* radiance) const;
  void LightRocks(const RayPacket& rays, int count, SurfacePoint* points) const;
  void AddLamp(const RayPacket& rays, int count, const Lamp& lamp, const SurfacePoint* points,
               float* radiance) const;

  int width_;
  int height_;
  float pixel_;  ///< rad a pixel
  const Scene& scene_;
  const Photometry& photometry_;
  ThreadPool* pool_;
  std::vector<Eigen::Vector3f> bearings_;  ///< camera frame, by pixel
};

}  // namespace regolith
