// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/photometry.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kMoonSunRadius = 0.2665 * kDegree;
constexpr double kMarsSunRadius = 0.175 * kDegree;

// Dust scatters forward (ω .975, g ≈ .69): seven tenths of what leaves the beam arrive from the
// sky, which gives the diffuse shares of Appelbaum & Flood 1990 (.33 at τ .5 and zenith 0°).
constexpr double kForwardShare = 0.7;
constexpr double kDustAsymmetry = 0.69;
constexpr double kScaleHeight = 11600.0;  // m, of the dust (Lemmon 2004)
constexpr float kUnseenHaze = 1e-3F;      // a grey level is four times as much
// Rock that stands free sees its own shadow too: a share of what level ground around would send.
constexpr float kGroundShare = 0.5F;

double HenyeyGreenstein(double asymmetry, double cosine_scattering) {
  const double squared = asymmetry * asymmetry;
  return (1.0 - squared) / std::pow(1.0 + squared - 2.0 * asymmetry * cosine_scattering, 1.5);
}

// Lunar–Lambert weight of the Lommel–Seeliger part at phase angle g (McEwen 1991).
double LimbParameter(double g_deg) {
  const double value = 1.0 - 0.019 * g_deg + 2.42e-4 * g_deg * g_deg - 1.46e-6 * std::pow(g_deg, 3);
  return std::clamp(value, 0.0, 1.0);
}

// Two-lobe Henyey–Greenstein with Hapke's opposition surge, mare at 566 nm (Sato et al. 2014).
double LunarPhase(double g) {
  constexpr double kB = 0.254;
  constexpr double kC = 0.158;
  constexpr double kB0 = 2.13;
  constexpr double kH = 0.062;
  const double cosine = std::cos(M_PI - g);
  const double lobes = 0.5 * (1.0 + kC) * HenyeyGreenstein(-kB, cosine) +
                       0.5 * (1.0 - kC) * HenyeyGreenstein(kB, cosine);
  const double surge = 1.0 + kB0 / (1.0 + std::tan(0.5 * g) / kH);
  return lobes * surge;
}

// Martian soil scatters back gently (Johnson et al. 2006: b .25, c .7), without a sharp surge.
double MartianPhase(double g) {
  const double cosine = std::cos(M_PI - g);
  return 0.85 * HenyeyGreenstein(-0.25, cosine) + 0.15 * HenyeyGreenstein(0.25, cosine);
}

float Lookup(float cosine, const float* table, size_t last) {
  const float place = std::clamp(0.5F * (cosine + 1.0F), 0.0F, 1.0F) * static_cast<float>(last);
  const auto index = std::min(static_cast<size_t>(place), last - 1);
  const float fraction = place - static_cast<float>(index);
  return table[index] + fraction * (table[index + 1] - table[index]);
}

}  // namespace

Photometry::Photometry(const std::string& planet, const SunOptions& sun, double ground_albedo)
    : ground_albedo_(static_cast<float>(ground_albedo)) {
  const double elevation = sun.elevation_deg * kDegree;
  const double azimuth = sun.azimuth_deg * kDegree;
  sun_.direction = Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation))
                       .cast<float>();
  const bool moon = planet == "moon";
  sun_.radius = static_cast<float>(moon ? kMoonSunRadius : kMarsSunRadius);
  const double sine = std::max(std::sin(elevation), 0.0);
  const double passed = sine > 0.0 ? std::exp(-sun.tau / sine) : 0.0;
  direct_ = static_cast<float>(passed);
  diffuse_ = static_cast<float>(kForwardShare * (1.0 - passed) * sine);
  extinction_ = static_cast<float>(sun.tau / kScaleHeight);
  tau_ = static_cast<float>(sun.tau);
  for (size_t i = 0; i <= kTable; ++i) {
    const double cosine = 2.0 * static_cast<double>(i) / kTable - 1.0;
    const double g = std::acos(std::min(cosine, 1.0));
    limb_[i] =
        static_cast<float>(moon ? LimbParameter(g / kDegree) : 0.5 * LimbParameter(g / kDegree));
    phase_[i] = static_cast<float>(moon ? LunarPhase(g) / LunarPhase(0.0)
                                        : MartianPhase(g) / MartianPhase(0.0));
  }
  if (diffuse_ > 0.0F) {
    // Cosine-weighted mean of the sky's shape over the hemisphere.
    constexpr int kSteps = 4096;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double share = (i + 0.5) / kSteps;
      const double angle = 2.3999632 * i;
      sum += static_cast<double>(
          SkyShape(Eigen::Vector3d(std::sqrt(share) * std::cos(angle),
                                   std::sqrt(share) * std::sin(angle), std::sqrt(1.0 - share))
                       .cast<float>()));
    }
    sky_scale_ = static_cast<float>(static_cast<double>(diffuse_) * kSteps / sum);
  }
  SurfacePoint level;
  level.albedo = ground_albedo_;
  level.light = static_cast<float>(sine);
  level.fill = diffuse_;
  level_ground_ = Ground(level, Eigen::Vector3f::UnitZ());
}

float Photometry::Scattered(float light, float incidence, float emission,
                            float cosine_phase) const {
  const float limb = Lookup(cosine_phase, limb_.data(), kTable);
  // I/F = A f(g) [2 L μ0 / (μ0 + μ) + (1 - L) μ0].
  return light * Lookup(cosine_phase, phase_.data(), kTable) *
         (2.0F * limb / (incidence + emission) + (1.0F - limb));
}

float Photometry::Ground(const SurfacePoint& point, const Eigen::Vector3f& to_viewer) const {
  const float emission = std::max(point.normal.dot(to_viewer), 0.05F);
  float light = point.fill;
  if (point.light > 0.0F) {
    const float incidence = std::max(point.normal.dot(sun_.direction), point.light);
    light += direct_ * Scattered(point.light, incidence, emission, sun_.direction.dot(to_viewer));
  }
  return point.albedo * light;
}

float Photometry::LitBy(const SurfacePoint& point, const Eigen::Vector3f& to_light,
                        float irradiance, const Eigen::Vector3f& to_viewer) const {
  const float incidence = point.normal.dot(to_light);
  if (incidence <= 0.0F) return 0.0F;
  const float emission = std::max(point.normal.dot(to_viewer), 0.05F);
  return point.albedo * irradiance *
         Scattered(incidence, incidence, emission, to_light.dot(to_viewer));
}

float Photometry::FillOutside(const Eigen::Vector3f& normal) const {
  const float up = 0.5F * (1.0F + normal.z());
  return up * diffuse_ + (1.0F - up) * kGroundShare * level_ground_;
}

// Brighter towards the sun, and towards the horizon as the way through the dust grows.
float Photometry::SkyShape(const Eigen::Vector3f& direction) const {
  const auto cosine = static_cast<double>(direction.dot(sun_.direction));
  const auto aureole = static_cast<float>(std::min(HenyeyGreenstein(kDustAsymmetry, cosine), 4.0));
  const float horizon = 1.0F - std::exp(-tau_ / std::max(direction.z(), 0.02F));
  return horizon * (0.6F + 0.4F * aureole);
}

float Photometry::SkyWithoutSun(const Eigen::Vector3f& direction) const {
  return sky_scale_ > 0.0F ? sky_scale_ * SkyShape(direction) : 0.0F;
}

float Photometry::Sky(const Eigen::Vector3f& direction) const {
  if (direction.dot(sun_.direction) > std::cos(sun_.radius)) return 1e4F * direct_;
  return SkyWithoutSun(direction);
}

float Photometry::ThroughAir(float radiance, const Eigen::Vector3f& direction,
                             float distance) const {
  const float depth = extinction_ * distance;
  if (depth < kUnseenHaze) return radiance;
  const float passed = std::exp(-depth);
  Eigen::Vector3f level(direction.x(), direction.y(), 0.0F);
  return passed * radiance + (1.0F - passed) * SkyWithoutSun(level.normalized());
}

}  // namespace regolith
