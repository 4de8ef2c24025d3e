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

// Light from sunlit ground into a shadow: a few per cent of what the ground scatters, albedo .12,
// from the small part of the upper hemisphere that slopes fill.
constexpr float kMoonBounce = 0.012F;
constexpr float kMarsBounce = 0.03F;

// Dust scatters forward (ω .975, g ≈ .69): seven tenths of what leaves the beam arrive from the
// sky, which gives the diffuse shares of Appelbaum & Flood 1990 (.33 at τ .5 and zenith 0°).
constexpr double kForwardShare = 0.7;
constexpr double kDustAsymmetry = 0.69;

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

}  // namespace

Photometry::Photometry(const std::string& planet, const SunOptions& sun) {
  const double elevation = sun.elevation_deg * kDegree;
  const double azimuth = sun.azimuth_deg * kDegree;
  sun_.direction = Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation))
                       .cast<float>();
  const bool moon = planet == "moon";
  sun_.radius = static_cast<float>(moon ? kMoonSunRadius : kMarsSunRadius);
  bounce_ = moon ? kMoonBounce : kMarsBounce;
  const double passed = std::exp(-sun.tau / std::sin(elevation));
  direct_ = static_cast<float>(passed);
  diffuse_ = static_cast<float>(kForwardShare * (1.0 - passed) * std::sin(elevation));
  for (size_t i = 0; i <= kTable; ++i) {
    const double cosine = 2.0 * static_cast<double>(i) / kTable - 1.0;
    const double g = std::acos(std::min(cosine, 1.0));
    limb_[i] =
        static_cast<float>(moon ? LimbParameter(g / kDegree) : 0.5 * LimbParameter(g / kDegree));
    phase_[i] = static_cast<float>(moon ? LunarPhase(g) / LunarPhase(0.0)
                                        : MartianPhase(g) / MartianPhase(0.0));
  }
}

float Photometry::PhaseAt(float cosine, const std::array<float, kTable + 1>& table) const {
  const float place = std::clamp(0.5F * (cosine + 1.0F), 0.0F, 1.0F) * static_cast<float>(kTable);
  const auto index = std::min(static_cast<size_t>(place), kTable - 1);
  const float fraction = place - static_cast<float>(index);
  return table[index] + fraction * (table[index + 1] - table[index]);
}

float Photometry::Ground(const Eigen::Vector3f& normal, const Eigen::Vector3f& to_viewer,
                         float albedo, float sunlit) const {
  const float incidence = std::max(normal.dot(sun_.direction), 0.0F);
  const float emission = std::max(normal.dot(to_viewer), 0.05F);
  const float cosine_phase = sun_.direction.dot(to_viewer);
  float light = 0.0F;
  if (sunlit > 0.0F && incidence > 0.0F) {
    const float limb = PhaseAt(cosine_phase, limb_);
    // McEwen 1991: I/F = A f(g) [2 L μ0 / (μ0 + μ) + (1 - L) μ0].
    light = direct_ * sunlit * PhaseAt(cosine_phase, phase_) *
            (2.0F * limb * incidence / (incidence + emission) + (1.0F - limb) * incidence);
  }
  const float sky_seen = 0.5F * (1.0F + normal.z());
  const float fill = diffuse_ * sky_seen + direct_ * sun_.direction.z() * bounce_;
  return albedo * (light + fill);
}

float Photometry::Sky(const Eigen::Vector3f& direction) const {
  const float cosine = direction.dot(sun_.direction);
  if (cosine > std::cos(sun_.radius)) return 1e4F * direct_;
  if (diffuse_ <= 0.0F) return 0.0F;
  // The mean of the hemisphere is the diffuse light; brighter towards the sun and the horizon.
  const double aureole = HenyeyGreenstein(kDustAsymmetry, cosine);
  const float horizon = 1.0F - 0.35F * std::max(direction.z(), 0.0F);
  return diffuse_ * horizon * (0.6F + 0.4F * static_cast<float>(std::min(aureole, 4.0)));
}

}  // namespace regolith
