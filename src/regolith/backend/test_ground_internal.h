// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Generated ground and a lidar that stands on it, for tests.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "regolith/core/random.h"
#include "regolith/geometry/se3.h"
#include "regolith/geometry/so3.h"
#include "regolith/terrain/surface.h"

namespace regolith {

inline constexpr double kGroundPi = 3.14159265358979323846;

/// A square of ground about the origin, rocks included.
class TestGround {
 public:
  TestGround(const TerrainOptions& terrain, uint64_t seed, double half_size = 31.0) {
    const Eigen::AlignedBox2d box(Eigen::Vector2d::Constant(-half_size),
                                  Eigen::Vector2d::Constant(half_size));
    grid_ = SampleSurface(*CreateGeneratedSurface(terrain, seed, box), box, 0.125,
                          Eigen::Vector3d::Zero());
  }

  double Height(double x, double y) const {
    const double column = (x - grid_.origin.x()) / grid_.spacing;
    const double row = (grid_.origin.y() - y) / grid_.spacing;
    const int left = std::clamp(static_cast<int>(column), 0, grid_.columns - 2);
    const int upper = std::clamp(static_cast<int>(row), 0, grid_.rows - 2);
    const double right = std::clamp(column - left, 0.0, 1.0);
    const double lower = std::clamp(row - upper, 0.0, 1.0);
    return (1.0 - lower) *
               ((1.0 - right) * grid_.At(left, upper) + right * grid_.At(left + 1, upper)) +
           lower *
               ((1.0 - right) * grid_.At(left, upper + 1) + right * grid_.At(left + 1, upper + 1));
  }

  /// T_world_body of a rover at (x, y) that heads for `yaw`, with its lidar 1.2 m above ground.
  SE3 Stand(double x, double y, double yaw) const {
    constexpr double kReach = 0.6;  // m
    const Eigen::Vector3d normal((Height(x - kReach, y) - Height(x + kReach, y)) / (2.0 * kReach),
                                 (Height(x, y - kReach) - Height(x, y + kReach)) / (2.0 * kReach),
                                 1.0);
    return {
        RotationBetween(Eigen::Vector3d::UnitZ(), normal.normalized()) * ExpSo3({0.0, 0.0, yaw}),
        {x, y, Height(x, y) + 1.2}};
  }

  /// What a lidar of 16 rings sees within 20 m, in its own frame (that of the body).
  std::vector<Eigen::Vector3d> Scan(const SE3& T_world_body, uint64_t seed) const {
    Random random(seed);
    std::vector<Eigen::Vector3d> points;
    for (int column = 0; column < 360; ++column) {
      const double azimuth = (column + random.Uniform()) * kGroundPi / 180.0;
      for (int ring = 0; ring < 8; ++ring) {
        const double elevation = -(15.0 - 2.0 * ring) * kGroundPi / 180.0;
        const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                        std::cos(elevation) * std::sin(azimuth),
                                        std::sin(elevation));
        const double range = Range(T_world_body, direction);
        if (range < 20.0) points.push_back((range + random.Gaussian(0.0, 0.02)) * direction);
      }
    }
    return points;
  }

 private:
  double Clearance(const SE3& T_world_body, const Eigen::Vector3d& direction, double range) const {
    const Eigen::Vector3d point = T_world_body * (range * direction);
    return point.z() - Height(point.x(), point.y());
  }

  double Range(const SE3& T_world_body, const Eigen::Vector3d& direction) const {
    constexpr double kStep = 0.2;  // m
    for (double range = 2.0; range < 20.0; range += kStep) {
      const double after = Clearance(T_world_body, direction, range);
      if (after > 0.0) continue;
      const double before = Clearance(T_world_body, direction, range - kStep);
      return range - kStep * after / std::min(after - before, -1e-9);
    }
    return 20.0;
  }

  HeightGrid grid_;
};

/// Keyframes of a rover on an oval, 1.5 m apart: lap after lap, each to the given side (m) of it,
/// forward or back.
inline std::vector<SE3> OvalLap(const TestGround& ground, double offset, bool back) {
  constexpr int kKeyframes = 34;
  std::vector<SE3> poses;
  for (int i = 0; i < kKeyframes; ++i) {
    const double angle = 2.0 * kGroundPi * (back ? kKeyframes - i - 0.5 : i) / kKeyframes;
    const double x = (9.5 + offset) * std::cos(angle);
    const double y = (6.5 + offset) * std::sin(angle);
    const double heading =
        std::atan2((6.5 + offset) * std::cos(angle), -(9.5 + offset) * std::sin(angle));
    poses.push_back(ground.Stand(x, y, back ? heading + kGroundPi : heading));
  }
  return poses;
}

inline TerrainOptions MoonGround() { return TerrainOptions(); }

inline TerrainOptions MarsGround() {
  TerrainOptions terrain;
  terrain.relief.slope_deg = 5.0;
  terrain.relief.statistic = SlopeStatistic::kRms;
  terrain.craters.density = 0.0;
  terrain.rocks.law = RockLaw::kGolombek;
  terrain.ripples.height = 0.02;
  return terrain;
}

}  // namespace regolith
