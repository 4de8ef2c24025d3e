// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include <Eigen/Core>

#include "regolith/sim/scenario_options.h"
#include "regolith/sim/sun_disc.h"
#include "regolith/sim/surface_point.h"

namespace regolith {

/// How ground and sky look under the sun: radiance as I/F (1 is a white Lambert surface facing the
/// sun above the air).
class Photometry {
 public:
  /// `ground_albedo`: mean normal albedo.
  Photometry(const std::string& planet, const SunOptions& sun, double ground_albedo);

  const SunDisc& sun() const { return sun_; }
  float ground_albedo() const { return ground_albedo_; }

  /// I/F of a surface, seen from the unit direction `to_viewer` (world).
  float Ground(const SurfacePoint& point, const Eigen::Vector3f& to_viewer) const;

  /// I/F of a surface by a light in the unit direction `to_light` alone, that sends `irradiance`
  /// (the sun's is 1) on a surface facing it.
  float LitBy(const SurfacePoint& point, const Eigen::Vector3f& to_light, float irradiance,
              const Eigen::Vector3f& to_viewer) const;

  /// I/F of level ground in full sun, seen from above.
  float LevelGround() const { return level_ground_; }

  /// What the sky alone sends down on level ground in the open, as a share of the sun's irradiance.
  float OpenSky() const { return diffuse_; }

  /// Light of sky and of lit level ground around on a surface with `normal` that stands free.
  float FillOutside(const Eigen::Vector3f& normal) const;

  /// I/F of the sky in the unit direction, world.
  float Sky(const Eigen::Vector3f& direction) const;
  float SkyWithoutSun(const Eigen::Vector3f& direction) const;

  /// What dust in the air leaves of `radiance` after `distance` m in `direction`, and adds to it.
  float ThroughAir(float radiance, const Eigen::Vector3f& direction, float distance) const;

 private:
  static constexpr size_t kTable = 1024;
  using Table = std::array<float, kTable + 1>;

  /// Light from one direction, per I/F of a white surface: McEwen 1991.
  float Scattered(float light, float incidence, float emission, float cosine_phase) const;
  float SkyShape(const Eigen::Vector3f& direction) const;

  SunDisc sun_;
  float ground_albedo_;
  float direct_;            // of the sun's irradiance, what passes the dust
  float diffuse_;           // of it, what the sky sends down on level ground
  float sky_scale_ = 0.0F;  // makes the sky send diffuse_
  float extinction_;        // 1/m
  float tau_;
  float level_ground_ = 0.0F;
  Table limb_{};   // L(g) by cos g
  Table phase_{};  // f(g) by cos g
};

}  // namespace regolith
