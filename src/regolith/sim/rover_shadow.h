// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/geometry/se3.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/sun_disc.h"

namespace regolith {

/// The rover's body as boxes at one instant: it keeps sunlight from the ground, and lidar beams
/// from going on.
class RoverShadow {
 public:
  RoverShadow(const std::vector<RoverBox>& body, const SE3& T_world_base);

  /// Share of the sun's disc that the rover leaves to `place` (m, world).
  float Sunlit(const Eigen::Vector3f& place, const SunDisc& sun) const;

  /// Whether the ray from `origin` (m, world) in the unit direction meets the rover.
  bool Hides(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

 private:
  struct Box {
    Eigen::Matrix3f R_box_world;
    Eigen::Vector3f centre;  // m, world
    Eigen::Vector3f half;    // m
    float radius;            // m, of the sphere around it

    bool Meets(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  };

  std::vector<Box> boxes_;
  Eigen::Vector3f centre_ = Eigen::Vector3f::Zero();  ///< m, world, of a sphere around all
  float radius_ = 0.0F;                               ///< m
};

}  // namespace regolith
