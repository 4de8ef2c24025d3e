// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scenes and a spinning lidar for tests.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "regolith/core/random.h"
#include "regolith/geometry/se3.h"
#include "regolith/sensor/lidar_scan.h"

namespace regolith {

inline constexpr double kTestPi = 3.14159265358979323846;

/// Distance (m, or less of it) from a point of the world to the nearest surface; negative inside.
using TestScene = std::function<double(const Eigen::Vector3d& point_world)>;

/// An upright box.
inline double ToBox(const Eigen::Vector3d& point, const Eigen::Vector3d& centre,
                    const Eigen::Vector3d& half_size) {
  const Eigen::Vector3d off = (point - centre).cwiseAbs() - half_size;
  return off.cwiseMax(0.0).norm() + std::min(off.maxCoeff(), 0.0);
}

struct TestLidar {
  int rings = 16;
  int columns = 450;
  double lowest_deg = -15.0;
  double highest_deg = 15.0;
  double max_range = 40.0;  ///< m
  double sigma = 0.01;      ///< m
  double period = 0.0;      ///< s a turn; 0: all at once

  double Elevation(int ring) const {
    return (lowest_deg + (highest_deg - lowest_deg) * ring / (rings - 1)) * kTestPi / 180.0;
  }
};

/// What the lidar sees of a scene from `pose_at(seconds from the start)`: T_world_lidar. Firings
/// after another, all rings of one at once.
template <typename PoseAt>
LidarScan CastScan(const TestLidar& lidar, const TestScene& scene, uint64_t seed,
                   const PoseAt& pose_at) {
  Random random(seed);
  LidarScan scan;
  for (int column = 0; column < lidar.columns; ++column) {
    const double time = lidar.period * column / lidar.columns;
    const SE3 T_world_lidar = pose_at(time);
    const double azimuth = 2.0 * kTestPi * (column + 0.5) / lidar.columns;
    for (int ring = 0; ring < lidar.rings; ++ring) {
      const double elevation = lidar.Elevation(ring);
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      double range = 0.3;
      double clearance = 1.0;
      while (range < lidar.max_range && clearance > 1e-3) {
        clearance = scene(T_world_lidar * (range * direction));
        range += std::max(clearance, 1e-3);
      }
      if (range >= lidar.max_range) continue;
      LidarPoint point;
      point.position = ((range + random.Gaussian(0.0, lidar.sigma)) * direction).cast<float>();
      point.ring = static_cast<uint16_t>(ring);
      point.time = static_cast<float>(time);
      scan.points.push_back(point);
    }
  }
  return scan;
}

inline LidarScan CastScan(const TestLidar& lidar, const TestScene& scene, uint64_t seed,
                          const SE3& T_world_lidar) {
  return CastScan(lidar, scene, seed, [&](double) { return T_world_lidar; });
}

/// A yard on gentle ground: walls 12 m around, pillars and boulders. Clearance is a bound: ground
/// is no steeper than 45°.
inline double TestYard(const Eigen::Vector3d& point) {
  const double ground =
      0.7 * (point.z() - 0.15 * std::sin(0.4 * point.x()) - 0.15 * std::cos(0.5 * point.y()));
  double nearest = std::min({ground, 12.0 - std::abs(point.x()), 12.0 - std::abs(point.y())});
  for (const Eigen::Vector2d& place :
       {Eigen::Vector2d(5, 4), Eigen::Vector2d(-6, 3), Eigen::Vector2d(3, -7),
        Eigen::Vector2d(-5, -5), Eigen::Vector2d(8, -2)}) {
    nearest = std::min(nearest,
                       ToBox(point, {place.x(), place.y(), 1.0}, Eigen::Vector3d(0.4, 0.3, 2.0)));
  }
  for (const Eigen::Vector3d& boulder :
       {Eigen::Vector3d(2, 6, 0.3), Eigen::Vector3d(-3, 7, 0.2), Eigen::Vector3d(7, 7, 0.4)}) {
    nearest = std::min(nearest, (point - boulder).norm() - 0.8);
  }
  return nearest;
}

}  // namespace regolith
