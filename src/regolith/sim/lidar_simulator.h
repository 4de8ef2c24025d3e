// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/core/thread_pool.h"
#include "regolith/sensor/lidar_scan.h"
#include "regolith/sim/ray_packet.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/scenario_options.h"
#include "regolith/sim/scene.h"

namespace regolith {

/// A spinning lidar as the VLP-16: the lasers of a firing go off one after the other (lowest, first
/// above the middle, second lowest, …) while the head turns and the body moves. A beam has a
/// footprint: what lies in it mixes where it is close together in range; else the strongest counts.
class LidarSimulator {
 public:
  LidarSimulator(const LidarOptions& options, const Scene& scene, const RoverMotion& motion,
                 uint64_t seed, ThreadPool* pool);

  /// The turn whose first firing is at `start` s; the stamp is left to the caller. Noise depends on
  /// the seed and `scan_index` alone. Beams that meet the rover itself are left out.
  LidarScan Scan(double start, uint64_t scan_index) const;

  /// Scales drop-outs so that their mean share within 30 m, over scans at `starts` (s), is the one
  /// asked for.
  void CalibrateDropout(const std::vector<double>& starts);

  /// Share of the rays lost that met ground within 30 m, over one scan.
  double DropoutShare(double start, uint64_t scan_index) const;

 private:
  struct Return {
    float range = 0.0F;   ///< m, noise-free; 0 where nothing was met
    float chance = 0.0F;  ///< of being lost, before scaling
    float intensity = 0.0F;
  };
  // What a part of a beam meets.
  struct Echo {
    float range;
    float energy;
    float cosine;
    float albedo;
  };
  static constexpr int kBeamRays = 3;

  void AimBeams();
  std::vector<Return> Cast(double start) const;
  struct Firing;
  void CastFirings(double start, int begin, int end, Return* returns) const;
  void AimLaser(const Firing& firing, int laser, int lane, RayPacket* rays) const;
  Return Receive(const RayPacket& rays, int first_lane) const;
  Return Combine(Echo* echoes, int count) const;
  bool Lost(const Return& echo, uint64_t scan_index, size_t beam) const;
  float DustRange(uint64_t scan_index, size_t beam) const;
  double LaserDelay(int laser) const { return laser * options_.laser_interval; }

  LidarOptions options_;
  const Scene& scene_;
  const RoverMotion& motion_;
  uint64_t seed_;
  ThreadPool* pool_;
  std::vector<int> rings_;                   ///< by laser, in the order of firing
  std::vector<Eigen::Vector3f> directions_;  ///< lidar frame, by firing and laser
  std::vector<char> masked_;                 ///< 1 where the rover stands in the way, likewise
  double dropout_scale_ = 0.0;
};

}  // namespace regolith
