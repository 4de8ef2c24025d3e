// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace regolith {

/// The sun as a light.
struct SunDisc {
  Eigen::Vector3f direction = Eigen::Vector3f::UnitZ();  ///< unit vector towards its centre, world
  float radius = 0.0F;                                   ///< half of its diameter, rad
};

/// Unit vectors to kCount points spread evenly over the disc (Vogel 1979).
template <size_t kCount>
std::array<Eigen::Vector3f, kCount> SpreadOverDisc(const SunDisc& sun) {
  constexpr float kGoldenAngle = 2.3999632F;  // rad
  const Eigen::Vector3f across = sun.direction.unitOrthogonal();
  const Eigen::Vector3f along = sun.direction.cross(across);
  std::array<Eigen::Vector3f, kCount> directions;
  for (size_t i = 0; i < kCount; ++i) {
    const float radius =
        sun.radius * std::sqrt((static_cast<float>(i) + 0.5F) / static_cast<float>(kCount));
    const float angle = kGoldenAngle * static_cast<float>(i);
    directions[i] = (sun.direction + radius * (std::cos(angle) * across + std::sin(angle) * along))
                        .normalized();
  }
  return directions;
}

}  // namespace regolith
