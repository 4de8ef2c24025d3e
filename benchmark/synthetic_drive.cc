// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic_drive.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRest = 1.2;          // s
constexpr double kAcceleration = 0.5;  // m/s², for one second
constexpr double kMast = 1.5;          // m above the mean ground
constexpr double kFarthest = 60.0;     // m
constexpr int kRings = 28;
constexpr int kFirings = 470;

double Ground(double x, double y) {
  return 0.4 * std::sin(0.15 * x + 0.5) * std::cos(0.12 * y) + 0.1 * std::sin(0.9 * x + 0.7 * y) +
         0.05 * std::cos(2.1 * x - 1.7 * y);
}

/// Slopes stay below 1, so that half the clearance never steps through the ground.
double Cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double range = 0.5;
  while (range < kFarthest) {
    const Eigen::Vector3d point = origin + range * direction;
    const double clearance = point.z() - Ground(point.x(), point.y());
    if (clearance < 1e-3) return range;
    range += std::max(1e-3, 0.5 * clearance);
  }
  return INFINITY;
}

LidarScan MakeScan(int index) {
  const double start = 0.1 * index;
  Random random(static_cast<uint64_t>(index));
  LidarScan scan;
  scan.stamp = FromSeconds(start);
  for (int firing = 0; firing < kFirings; ++firing) {
    const double time = 0.1 * firing / kFirings;
    const double azimuth = 2.0 * kPi * firing / kFirings;
    const SE3 pose = SyntheticPose(start + time);
    for (int ring = 0; ring < kRings; ++ring) {
      const double elevation = (-25.0 + 23.0 * ring / (kRings - 1)) * kPi / 180.0;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double range = Cast(pose.translation, direction);
      if (!std::isfinite(range)) continue;
      LidarPoint point;
      point.position = ((range + random.Gaussian(0.0, 0.01)) * direction).cast<float>();
      point.time = static_cast<float>(time);
      point.ring = static_cast<uint16_t>(ring);
      scan.points.push_back(point);
    }
  }
  return scan;
}

}  // namespace

SE3 SyntheticPose(double time) {
  const double moving = std::max(0.0, time - kRest);
  const double way = kAcceleration * (moving < 1.0 ? 0.5 * moving * moving : moving - 0.5);
  return {Eigen::Quaterniond::Identity(), {way, 0.0, kMast}};
}

ImuSample SyntheticImu(double time) {
  ImuSample sample;
  sample.time = FromSeconds(time);
  const bool speeding = time >= kRest && time < kRest + 1.0;
  sample.specific_force = {speeding ? kAcceleration : 0.0, 0.0, kSyntheticGravity};
  return sample;
}

const LidarScan& SyntheticScan(int index) {
  static std::map<int, LidarScan> scans;
  LidarScan& scan = scans[index];
  if (scan.points.empty()) scan = MakeScan(index);
  return scan;
}

std::vector<Eigen::Vector3d> Positions(const LidarScan& scan) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(scan.points.size());
  for (const LidarPoint& point : scan.points) positions.push_back(point.position.cast<double>());
  return positions;
}

std::vector<Eigen::Vector3d> SyntheticMap(int scans) {
  std::vector<Eigen::Vector3d> points_world;
  for (int i = 0; i < scans; ++i) {
    for (const LidarPoint& point : SyntheticScan(i).points) {
      const SE3 pose = SyntheticPose(0.1 * i + static_cast<double>(point.time));
      points_world.push_back(pose * point.position.cast<double>());
    }
  }
  return points_world;
}

}  // namespace regolith
