// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace regolith {

/// A rock that lies in the ground. It is a shape of RockShapes(), scaled by `diameter`, turned by
/// `yaw` about z and moved to (centre, ground).
struct Rock {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m, frame `map`
  double ground = 0.0;                               ///< m, frame `map`: the shape's z = 0
  double diameter = 0.1;                             ///< m, mean of its horizontal extents
  double yaw = 0.0;                                  ///< rad
  uint32_t shape = 0;                                ///< index of its shape
  float brightness = 1.0F;                           ///< albedo, as a factor of the ground's mean
};

/// An irregular, closed mesh of diameter 1 about the origin; what has z < 0 is buried.
struct RockShape {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;  ///< unit vectors, by vertex
  std::vector<std::array<uint32_t, 3>> triangles;
};

}  // namespace regolith
