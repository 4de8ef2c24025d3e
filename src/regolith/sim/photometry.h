// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "regolith/sim/scenario_options.h"
#include "regolith/sim/sun_disc.h"

namespace regolith {

/// How the ground and the sky look under the sun: radiance as I/F (1 is a white Lambert surface
/// facing the sun above the air).
class Photometry {
 public:
  Photometry(const std::string& planet, const SunOptions& sun);

  const SunDisc& sun() const { return sun_; }

  /// I/F of ground with `normal` and normal albedo `albedo`, seen from direction `to_viewer` (unit
  /// vectors, world), with the share `sunlit` of the sun's disc visible from it.
  float Ground(const Eigen::Vector3f& normal, const Eigen::Vector3f& to_viewer, float albedo,
               float sunlit) const;

  /// I/F of the sky in the unit direction, world.
  float Sky(const Eigen::Vector3f& direction) const;

 private:
  static constexpr size_t kTable = 1024;

  float PhaseAt(float cosine, const std::array<float, kTable + 1>& table) const;

  SunDisc sun_;
  float direct_;                           // of the sun's irradiance, what passes the dust
  float diffuse_;                          // of it, what the sky sends down on level ground
  float bounce_;                           // light from sunlit ground around, share of the direct
  std::array<float, kTable + 1> limb_{};   // L(g) by cos g
  std::array<float, kTable + 1> phase_{};  // f(g) by cos g
};

}  // namespace regolith
