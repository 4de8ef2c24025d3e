// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/lidar_simulator.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"
#include "regolith/sim/rover_geometry.h"
#include "regolith/sim/rover_shadow.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr float kDropoutRange = 30.0F;  // m, within which the mean share is defined
constexpr double kMostLost = 0.95;
// Streams of noise of one beam.
constexpr uint64_t kLostStream = 0;
constexpr uint64_t kRangeStream = 1;
constexpr uint64_t kDustStream = 2;
constexpr uint64_t kDustRangeStream = 3;
constexpr float kMoonAlbedo = 0.12F;  // gives intensity 100 at normal incidence
// Echoes closer together than the pulse is long (6 ns) are one.
constexpr size_t kBeamsAtOnce = 5;    // of three rays each in a packet
constexpr float kPulseLength = 0.9F;  // m
constexpr double kEdge = 0.3;         // of the divergence, from the axis: about one sigma
constexpr double kDustReach = 4.0;    // m, mean range of dust's returns
constexpr float kDustIntensity = 4.0F;

// How a return is lost: little light comes back at grazing incidence and from afar, and a beam
// that grazes is smeared over range; dark ground sends less.
float LossShape(float range, float cosine_incidence, float albedo) {
  const float grazing = 1.0F - cosine_incidence;
  return (0.1F + grazing * grazing) * (0.25F + range / kDropoutRange) *
         std::sqrt(kMoonAlbedo / std::max(albedo, 0.01F));
}

}  // namespace

LidarSimulator::LidarSimulator(const LidarOptions& options, const Scene& scene,
                               const RoverMotion& motion, uint64_t seed, ThreadPool* pool)
    : options_(options), scene_(scene), motion_(motion), seed_(seed), pool_(pool) {
  for (int laser = 0; laser < options.rings; ++laser) {
    const bool pairs = options.rings % 2 == 0;
    rings_.push_back(!pairs ? laser : laser / 2 + (laser % 2 == 0 ? 0 : options.rings / 2));
  }
  AimBeams();
}

void LidarSimulator::AimBeams() {
  const RoverShadow rover(RoverBody(), SE3{});
  const SE3 T_base_lidar = BaseFromLidar(options_);
  const Eigen::Vector3f origin = T_base_lidar.translation.cast<float>();
  const double turn_rate = 2.0 * M_PI * options_.rate;
  for (int firing = 0; firing < options_.firings; ++firing) {
    for (int laser = 0; laser < options_.rings; ++laser) {
      // Clockwise from straight ahead, seen from above, as Velodyne's turn.
      const double azimuth =
          -2.0 * M_PI * firing / options_.firings - turn_rate * LaserDelay(laser);
      const double share =
          options_.rings > 1
              ? static_cast<double>(rings_[static_cast<size_t>(laser)]) / (options_.rings - 1)
              : 0.0;
      const double elevation =
          kDegree * (options_.lowest_deg + share * (options_.highest_deg - options_.lowest_deg));
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      directions_.push_back(direction.cast<float>());
      const Eigen::Vector3f direction_base = (T_base_lidar.rotation * direction).cast<float>();
      // The head itself stands on the mast.
      masked_.push_back(rover.Hides(origin + 0.1F * direction_base, direction_base) ? 1 : 0);
    }
  }
}

std::vector<LidarSimulator::Return> LidarSimulator::Cast(double start) const {
  std::vector<Return> returns(directions_.size());
  pool_->ParallelFor(static_cast<size_t>(options_.firings), 10 * kBeamsAtOnce,
                     [&](size_t begin, size_t end, size_t) {
                       for (size_t first = begin; first < end; first += kBeamsAtOnce) {
                         CastFirings(start, static_cast<int>(first),
                                     static_cast<int>(std::min(first + kBeamsAtOnce, end)),
                                     returns.data());
                       }
                     });
  return returns;
}

// The body at the start of a firing.
struct LidarSimulator::Firing {
  size_t first_beam;
  Eigen::Matrix3f R_world_imu;
  Eigen::Matrix3f R_imu_lidar;
  Eigen::Vector3f lidar_imu;  // m
  Eigen::Vector3f imu_world;  // m
  Eigen::Vector3f velocity;   // m/s, world
  Eigen::Vector3f rate;       // rad/s, body
};

// The same laser of firings side by side: their rays keep together.
void LidarSimulator::CastFirings(double start, int begin, int end, Return* returns) const {
  const SE3 T_imu_lidar = BaseFromImu().Inverse() * BaseFromLidar(options_);
  std::vector<Firing> firings;
  for (int firing = begin; firing < end; ++firing) {
    const MotionState motion = motion_.At(start + firing / (options_.rate * options_.firings));
    firings.push_back(
        {static_cast<size_t>(firing) * static_cast<size_t>(options_.rings),
         motion.T_world_imu.rotation.toRotationMatrix().cast<float>(),
         T_imu_lidar.rotation.toRotationMatrix().cast<float>(),
         T_imu_lidar.translation.cast<float>(), motion.T_world_imu.translation.cast<float>(),
         motion.v_world_imu.cast<float>(), motion.angular_velocity_imu.cast<float>()});
  }
  RayPacket rays;
  for (int laser = 0; laser < options_.rings; ++laser) {
    for (int lane = 0; lane < kPacketSize; ++lane) {
      const auto firing = static_cast<size_t>(lane / kBeamRays);
      if (firing < firings.size()) {
        AimLaser(firings[firing], laser, lane, &rays);
      } else {
        rays.Off(lane);
      }
    }
    scene_.Intersect(&rays);
    for (size_t i = 0; i < firings.size(); ++i) {
      returns[firings[i].first_beam + static_cast<size_t>(laser)] =
          Receive(rays, static_cast<int>(i) * kBeamRays);
    }
  }
}

// A beam's rays stand in a triangle about its axis.
void LidarSimulator::AimLaser(const Firing& firing, int laser, int lane, RayPacket* rays) const {
  const size_t beam = firing.first_beam + static_cast<size_t>(laser);
  if (masked_[beam] != 0) {
    rays->Off(lane);
    return;
  }
  const auto across = static_cast<float>(kEdge * options_.divergence_across);
  const auto along = static_cast<float>(kEdge * options_.divergence_along);
  const Eigen::Vector3f& axis = directions_[beam];
  const Eigen::Vector3f left = Eigen::Vector3f(-axis.y(), axis.x(), 0.0F).normalized();
  const Eigen::Vector3f up = axis.cross(left);
  const int part = lane % kBeamRays;
  const Eigen::Vector3f direction =
      part == 0
          ? Eigen::Vector3f(axis + 1.15F * along * up)
          : Eigen::Vector3f(axis + (part == 1 ? across : -across) * left - 0.58F * along * up);
  // The few microseconds since the firing's start: the body's motion is linear.
  const auto delay = static_cast<float>(LaserDelay(laser));
  const auto move = [&](const Eigen::Vector3f& v) -> Eigen::Vector3f {
    return firing.R_world_imu * (v + delay * firing.rate.cross(v));
  };
  rays->Set(lane, firing.imu_world + delay * firing.velocity + move(firing.lidar_imu),
            move(firing.R_imu_lidar * direction).normalized(),
            static_cast<float>(options_.max_range));
}

LidarSimulator::Return LidarSimulator::Receive(const RayPacket& rays, int first_lane) const {
  Echo echoes[kBeamRays];
  int count = 0;
  for (int part = 0; part < kBeamRays; ++part) {
    const int lane = first_lane + part;
    const float range = rays.distance[lane];
    if (!(range >= options_.min_range && range <= options_.max_range)) continue;
    const auto width = static_cast<float>(kEdge * options_.divergence_across) * range;
    const SurfacePoint point = scene_.Look(rays, lane, width, width);
    const float cosine = std::clamp(-point.normal.dot(rays.Direction(lane)), 0.01F, 1.0F);
    echoes[count++] = {range, cosine * point.albedo / (kBeamRays * range * range), cosine,
                       point.albedo};
  }
  return Combine(echoes, count);
}

// Echoes by range; the group of close ones with the most energy is the return.
LidarSimulator::Return LidarSimulator::Combine(Echo* echoes, int count) const {
  std::sort(echoes, echoes + count, [](const Echo& a, const Echo& b) { return a.range < b.range; });
  Return best;
  float best_energy = 0.0F;
  for (int begin = 0; begin < count;) {
    Echo sum{0.0F, 0.0F, 0.0F, 0.0F};
    int end = begin;
    while (end < count && echoes[end].range - echoes[begin].range < kPulseLength) {
      const Echo& echo = echoes[end++];
      sum.range += echo.energy * echo.range;
      sum.cosine += echo.energy * echo.cosine;
      sum.albedo += echo.energy * echo.albedo;
      sum.energy += echo.energy;
    }
    if (sum.energy > best_energy) {
      best_energy = sum.energy;
      best.range = sum.range / sum.energy;
      const float cosine = sum.cosine / sum.energy;
      const float albedo = sum.albedo / sum.energy;
      best.chance = LossShape(best.range, cosine, albedo);
      best.intensity =
          std::min(100.0F / kMoonAlbedo * sum.energy * best.range * best.range, 255.0F);
    }
    begin = end;
  }
  return best;
}

bool LidarSimulator::Lost(const Return& echo, uint64_t scan_index, size_t beam) const {
  const double chance = std::min(dropout_scale_ * static_cast<double>(echo.chance), kMostLost);
  return HashUniform(seed_, scan_index, beam, kLostStream) < chance;
}

// 0 where no dust sends the beam back.
float LidarSimulator::DustRange(uint64_t scan_index, size_t beam) const {
  if (options_.dust_returns <= 0.0 ||
      HashUniform(seed_, scan_index, beam, kDustStream) >= options_.dust_returns) {
    return 0.0F;
  }
  const double share = HashUniform(seed_, scan_index, beam, kDustRangeStream);
  return static_cast<float>(options_.min_range - kDustReach * std::log(1.0 - 0.99 * share));
}

LidarScan LidarSimulator::Scan(double start, uint64_t scan_index) const {
  const std::vector<Return> returns = Cast(start);
  LidarScan scan;
  scan.points.reserve(returns.size());
  for (size_t beam = 0; beam < returns.size(); ++beam) {
    Return echo = returns[beam];
    const float dust = masked_[beam] != 0 ? 0.0F : DustRange(scan_index, beam);
    if (dust > 0.0F && (echo.range <= 0.0F || dust < echo.range)) {
      echo = {dust, 0.0F, kDustIntensity};
    }
    if (echo.range <= 0.0F || Lost(echo, scan_index, beam)) continue;
    const double range = static_cast<double>(echo.range) +
                         options_.range_sigma * HashGaussian(seed_, scan_index, beam, kRangeStream);
    const auto laser = static_cast<int>(beam % static_cast<size_t>(options_.rings));
    const auto firing = static_cast<int>(beam / static_cast<size_t>(options_.rings));
    LidarPoint point;
    point.position = static_cast<float>(range) * directions_[beam];
    point.intensity = echo.intensity;
    point.time =
        static_cast<float>(firing / (options_.rate * options_.firings) + LaserDelay(laser));
    point.ring = static_cast<uint16_t>(rings_[static_cast<size_t>(laser)]);
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
    for (const float chance : chances) {
      sum += std::min(dropout_scale_ * static_cast<double>(chance), kMostLost);
    }
    (sum > options_.dropout * static_cast<double>(chances.size()) ? high : low) = dropout_scale_;
  }
  dropout_scale_ = low;
}

double LidarSimulator::DropoutShare(double start, uint64_t scan_index) const {
  const std::vector<Return> returns = Cast(start);
  double met = 0.0;
  double lost = 0.0;
  for (size_t beam = 0; beam < returns.size(); ++beam) {
    if (returns[beam].range <= 0.0F || returns[beam].range >= kDropoutRange) continue;
    met += 1.0;
    if (Lost(returns[beam], scan_index, beam)) lost += 1.0;
  }
  return met > 0.0 ? lost / met : 0.0;
}

}  // namespace regolith
