// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/core/thread_pool.h"
#include "regolith/sensor/lidar_scan.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/scenario_options.h"
#include "regolith/sim/terrain_mesh.h"

namespace regolith {

/// A spinning lidar: each firing casts all rings from the body's pose at its own time. A beam is a
/// line: it has no footprint yet.
class LidarSimulator {
 public:
  LidarSimulator(const LidarOptions& options, const TerrainMesh& mesh, const RoverMotion& motion,
                 uint64_t seed, ThreadPool* pool);

  /// The turn whose first firing is at `start` s; the stamp is left to the caller. Noise depends on
  /// the seed and `scan_index` alone.
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
  std::vector<Return> Cast(double start) const;
  void CastFiring(double start, int firing, Return* returns) const;
  bool Lost(const Return& echo, uint64_t scan_index, size_t ray) const;

  LidarOptions options_;
  const TerrainMesh& mesh_;
  const RoverMotion& motion_;
  uint64_t seed_;
  ThreadPool* pool_;
  std::vector<Eigen::Vector3f> directions_;  ///< lidar frame, by firing and ring
  double dropout_scale_ = 0.0;
};

}  // namespace regolith
