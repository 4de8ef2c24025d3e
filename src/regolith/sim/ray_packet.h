// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace regolith {

inline constexpr int kPacketSize = 16;
/// Id of what a ray meets where it meets nothing.
inline constexpr uint32_t kNothing = ~0U;

/// Rays cast together, frame world, m; directions are unit vectors. Lanes with limit < 0 are off.
struct alignas(64) RayPacket {
  float origin_x[kPacketSize];
  float origin_y[kPacketSize];
  float origin_z[kPacketSize];
  float direction_x[kPacketSize];
  float direction_y[kPacketSize];
  float direction_z[kPacketSize];
  float limit[kPacketSize];     ///< m; the ray ends here
  float distance[kPacketSize];  ///< result: m; infinite where nothing is met
  // Results for Scene::Look: which object and where on it.
  uint32_t object[kPacketSize];
  uint32_t triangle[kPacketSize];
  float u[kPacketSize];
  float v[kPacketSize];

  void Set(int lane, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
           float ray_limit) {
    origin_x[lane] = origin.x();
    origin_y[lane] = origin.y();
    origin_z[lane] = origin.z();
    direction_x[lane] = direction.x();
    direction_y[lane] = direction.y();
    direction_z[lane] = direction.z();
    limit[lane] = ray_limit;
  }
  void Off(int lane) { Set(lane, Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), -1.0F); }

  Eigen::Vector3f Direction(int lane) const {
    return {direction_x[lane], direction_y[lane], direction_z[lane]};
  }
  Eigen::Vector3f Point(int lane) const {
    return Eigen::Vector3f(origin_x[lane], origin_y[lane], origin_z[lane]) +
           distance[lane] * Direction(lane);
  }
};

}  // namespace regolith
