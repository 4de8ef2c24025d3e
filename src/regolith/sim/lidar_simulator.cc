// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/lidar_simulator.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"
#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr float kDropoutRange = 30.0F;  // m, within which the mean share is defined
constexpr double kMostLost = 0.95;
// Streams of noise of one ray.
constexpr uint64_t kLostStream = 0;
constexpr uint64_t kRangeStream = 1;
constexpr float kMoonAlbedo = 0.12F;  // gives intensity 100 at normal incidence

// How a return is lost: little light comes back at grazing incidence and from afar, and a beam
// that grazes is smeared over range.
float LossShape(float range, float cosine_incidence) {
  const float grazing = 1.0F - cosine_incidence;
  return (0.1F + grazing * grazing) * (0.25F + range / kDropoutRange);
}

}  // namespace

LidarSimulator::LidarSimulator(const LidarOptions& options, const TerrainMesh& mesh,
                               const RoverMotion& motion, uint64_t seed, ThreadPool* pool)
    : options_(options), mesh_(mesh), motion_(motion), seed_(seed), pool_(pool) {
  for (int firing = 0; firing < options.firings; ++firing) {
    // Clockwise from straight ahead, seen from above, as Velodyne's turn.
    const double azimuth = -2.0 * M_PI * firing / options.firings;
    for (int ring = 0; ring < options.rings; ++ring) {
      const double share =
          options.rings > 1 ? static_cast<double>(ring) / (options.rings - 1) : 0.0;
      const double elevation =
          kDegree * (options.lowest_deg + share * (options.highest_deg - options.lowest_deg));
      directions_.push_back(Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                            std::cos(elevation) * std::sin(azimuth),
                                            std::sin(elevation))
                                .cast<float>());
    }
  }
}

std::vector<LidarSimulator::Return> LidarSimulator::Cast(double start) const {
  std::vector<Return> returns(directions_.size());
  constexpr size_t kFiringsAtOnce = 50;
  pool_->ParallelFor(static_cast<size_t>(options_.firings), kFiringsAtOnce,
                     [&](size_t begin, size_t end, size_t) {
                       for (size_t firing = begin; firing < end; ++firing) {
                         CastFiring(start, static_cast<int>(firing),
                                    &returns[firing * static_cast<size_t>(options_.rings)]);
                       }
                     });
  return returns;
}

void LidarSimulator::CastFiring(double start, int firing, Return* returns) const {
  const double time = start + firing / (options_.rate * options_.firings);
  const SE3 T_world_lidar =
      motion_.PoseAt(time) * (BaseFromImu().Inverse() * BaseFromLidar(options_));
  const Eigen::Matrix3f R_world_lidar = T_world_lidar.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f origin = T_world_lidar.translation.cast<float>();
  const auto first = static_cast<size_t>(firing) * static_cast<size_t>(options_.rings);
  for (int ring = 0; ring < options_.rings; ring += kPacketSize) {
    RayPacket rays;
    for (int lane = 0; lane < kPacketSize; ++lane) {
      const bool on = ring + lane < options_.rings;
      const size_t ray = first + static_cast<size_t>(std::min(ring + lane, options_.rings - 1));
      rays.Set(lane, origin, (R_world_lidar * directions_[ray]).normalized(),
               on ? static_cast<float>(options_.max_range) : -1.0F);
    }
    mesh_.Intersect(&rays, false);
    for (int lane = 0; lane < kPacketSize && ring + lane < options_.rings; ++lane) {
      const float range = rays.distance[lane];
      if (!(range >= options_.min_range && range <= options_.max_range)) continue;
      const Eigen::Vector3f place = rays.Point(lane);
      const GroundPoint ground = mesh_.At(place.x(), place.y());
      const float cosine = std::clamp((origin - place).dot(ground.normal) / range, 0.0F, 1.0F);
      Return& echo = returns[ring + lane];
      echo.range = range;
      echo.chance = LossShape(range, cosine);
      echo.intensity = 100.0F * ground.albedo / kMoonAlbedo * cosine;
    }
  }
}

bool LidarSimulator::Lost(const Return& echo, uint64_t scan_index, size_t ray) const {
  const double chance = std::min(dropout_scale_ * echo.chance, kMostLost);
  return HashUniform(seed_, scan_index, ray, kLostStream) < chance;
}

LidarScan LidarSimulator::Scan(double start, uint64_t scan_index) const {
  const std::vector<Return> returns = Cast(start);
  LidarScan scan;
  scan.points.reserve(returns.size());
  for (size_t ray = 0; ray < returns.size(); ++ray) {
    const Return& echo = returns[ray];
    if (echo.range <= 0.0F || Lost(echo, scan_index, ray)) continue;
    const double range =
        echo.range + options_.range_sigma * HashGaussian(seed_, scan_index, ray, kRangeStream);
    const auto firing = static_cast<int>(ray) / options_.rings;
    LidarPoint point;
    point.position = static_cast<float>(range) * directions_[ray];
    point.intensity = echo.intensity;
    point.time = static_cast<float>(firing / (options_.rate * options_.firings));
    point.ring = static_cast<uint16_t>(static_cast<int>(ray) % options_.rings);
    scan.points.push_back(point);
  }
  return scan;
}

void LidarSimulator::CalibrateDropout(const std::vector<double>& starts) {
  std::vector<float> chances;
  for (const double start : starts) {
    for (const Return& echo : Cast(start)) {
      if (echo.range > 0.0F && echo.range < kDropoutRange) chances.push_back(echo.chance);
    }
  }
  // Scaling moves some chances against their ceiling, so the mean is searched, not divided.
  double low = 0.0;
  double high = 100.0;
  for (int i = 0; i < 40; ++i) {
    dropout_scale_ = 0.5 * (low + high);
    double sum = 0.0;
    for (const float chance : chances) sum += std::min(dropout_scale_ * chance, kMostLost);
    (sum > options_.dropout * static_cast<double>(chances.size()) ? high : low) = dropout_scale_;
  }
  dropout_scale_ = low;
}

double LidarSimulator::DropoutShare(double start, uint64_t scan_index) const {
  const std::vector<Return> returns = Cast(start);
  double met = 0.0;
  double lost = 0.0;
  for (size_t ray = 0; ray < returns.size(); ++ray) {
    if (returns[ray].range <= 0.0F || returns[ray].range >= kDropoutRange) continue;
    met += 1.0;
    if (Lost(returns[ray], scan_index, ray)) lost += 1.0;
  }
  return met > 0.0 ? lost / met : 0.0;
}

}  // namespace regolith
