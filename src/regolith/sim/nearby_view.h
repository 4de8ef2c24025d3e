// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/geometry/se3.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sim/rendered_view.h"
#include "regolith/sim/scene.h"

namespace regolith {

/// Whether two neighbouring rays see the sky, or one piece of ground: distances differ by at most
/// `tolerance` of the nearer.
bool SeeOneSurface(const Scene& scene, const RayEnd& one, const RayEnd& other, float tolerance);

/// What another camera, of the same intrinsics and attitude, saw in the same instant from some
/// centimetres to the side. A ray of this camera ends where a ray of that one does, unless there is
/// an edge between them; so most rays need not be cast again.
class NearbyView {
 public:
  /// `view` and `scene` must outlive this; `baseline` (m) is the farthest that it is asked from.
  NearbyView(const RenderedView& view, const SE3& T_world_camera,
             const CameraIntrinsics& intrinsics, double baseline, const Scene& scene);

  /// Where the ray of pixel (column, row) ends, which goes from `origin` (m, world) in the unit
  /// direction `direction`. Nothing near edges, rocks and the border, where it has to be cast.
  std::optional<RayEnd> Find(int column, int row, const Eigen::Vector3f& origin,
                             const Eigen::Vector3f& direction) const;

 private:
  struct Place {
    Eigen::Vector2f pixel;
    float distance;  // m, from the nearby camera
  };

  std::optional<Place> See(const Eigen::Vector3f& point_world) const;
  float Distance(const Eigen::Vector2f& pixel) const;
  void MarkEdges();
  void MarkEdge(const RayEnd& one, const RayEnd& other, int column, int row);

  const RenderedView& view_;
  const Scene& scene_;
  Eigen::Matrix3f R_camera_world_;
  Eigen::Vector3f origin_;  ///< m, world
  Eigen::Vector2f focal_;   ///< pixels
  Eigen::Vector2f principal_point_;
  std::array<float, 4> distortion_;
  float parallax_;            ///< m · pixels: an edge's, by the difference of inverse distances
  std::vector<char> broken_;  ///< by pixel: 1 near an edge, and on rocks
};

}  // namespace regolith
