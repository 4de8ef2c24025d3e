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
#include "regolith/sim/nearby_view.h"
#include "regolith/sim/photometry.h"
#include "regolith/sim/rendered_view.h"
#include "regolith/sim/rover_shadow.h"
#include "regolith/sim/scene.h"

namespace regolith {

/// What stands beside the ground and changes from frame to frame.
struct Surroundings {
  const RoverShadow* rover = nullptr;  ///< none where null
  Lamp lamp;
};

/// Casts the rays of a camera. Ground without a crest between two rays has an inverse distance that
/// is linear in the image (exactly so for a plane), so a ray between two that nearly agree is
/// interpolated: a third of the rays give the same picture. Far ground, whose pixels are much
/// longer than wide, is looked at between the lines too; pixels with an edge in four places.
class Renderer {
 public:
  Renderer(const CameraIntrinsics& intrinsics, const Scene& scene, const Photometry& photometry,
           ThreadPool* pool);

  /// `nearby`: what a camera close by sees just now, where there is one; saves rays.
  void Render(const SE3& T_world_camera, const Surroundings& surroundings, RenderedView* view,
              const NearbyView* nearby = nullptr) const;

  /// The unit vector of a pixel in the camera's frame.
  const Eigen::Vector3f& bearing(int column, int row) const {
    const int pixel = row * width_ + column;
    return bearings_[static_cast<size_t>(pixel)];
  }

 private:
  struct Pose {
    Eigen::Matrix3f R_world_camera;
    Eigen::Vector3f origin;  // m, world
    const NearbyView* nearby;
  };
  // The rays of an image line and what they meet.
  struct Line {
    int row;
    std::vector<Eigen::Vector3f> directions;  // unit vectors, world
    std::vector<float> distances;             // m; infinite where nothing is met
    std::vector<uint32_t> objects;
    std::vector<uint32_t> triangles;
    std::vector<float> u;
    std::vector<float> v;
  };

  Line Aim(const Pose& pose, int row, float down) const;
  void CastColumns(const Pose& pose, Span<const int> columns, Line* line) const;
  void CastSparse(const Pose& pose, Line* line) const;
  void CastBetween(const Pose& pose, const Line& above, const Line& below, Line* line) const;
  bool Interpolate(const Pose& pose, const RayEnd& one, const RayEnd& other, float tolerance,
                   Line* line, int column) const;
  void RenderRows(const Pose& pose, const Surroundings& surroundings, int begin, int end,
                  RenderedView* view) const;
  void ShadeLine(const Pose& pose, const Surroundings& surroundings, const Line& line,
                 Span<const char> wanted, float* radiance) const;
  void RefineRows(const Pose& pose, const Surroundings& surroundings, int begin, int end,
                  RenderedView* view) const;
  void RefineFar(const Pose& pose, const Surroundings& surroundings, int begin,
                 const std::vector<std::vector<char>>& far, RenderedView* view) const;
  void CastHalfway(const Pose& pose, const RenderedView& view, int upper_row,
                   Span<const char> wanted, Line* line) const;
  void RefineEdges(const Pose& pose, const Surroundings& surroundings, int row,
                   Span<const int> columns, RenderedView* view) const;
  bool OnEdge(const RenderedView& view, int column, int row) const;
  Eigen::Vector3f Between(int column, int row, float right, float down) const;
  void Shade(const RayPacket& rays, int count, float width, float far_height,
             const Surroundings& surroundings, float* radiance) const;
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
