// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace regolith {

/// Where a crater's ejecta blanket ends, radii (McGetchin et al. 1973: 2.3 to 2.7).
inline constexpr double kCraterReach = 2.3;

/// Knots of CraterProfile over [0, kCraterReach] and one where it is zero.
inline constexpr int kProfileKnots = 64;

/// Height over distance (radii) of a crater, in units of its depth from rim crest to floor; once
/// continuously differentiable, zero from kCraterReach on.
struct CraterProfile {
  double depth = 1.0;  ///< as a share of the fresh crater's
  float height[kProfileKnots + 2] = {};
  float slope[kProfileKnots + 2] = {};  ///< by knot
};

/// The height at `x` ≥ 0 radii (Hermite's cubic between the knots).
inline float ProfileHeight(const CraterProfile& profile, float x) {
  constexpr auto kScale = static_cast<float>(kProfileKnots / kCraterReach);
  constexpr auto kLast = static_cast<float>(kProfileKnots);
  const float t = std::min(x * kScale, kLast);
  const auto knot = static_cast<int32_t>(t);
  const float f = t - static_cast<float>(knot);
  const auto i = static_cast<uint32_t>(knot);
  const float rise = profile.height[i + 1] - profile.height[i];
  const float a = profile.slope[i] - rise;
  const float b = rise - profile.slope[i + 1];
  return profile.height[i] + f * rise + f * (1.0F - f) * ((1.0F - f) * a + f * b);
}

/// Profiles from fresh to nearly gone.
inline constexpr int kCraterStates = 24;

/// A fresh crater (Fassett and Thomson 2014 inside, McGetchin's ejecta outside) and what diffusion
/// (∂h/∂t = κ ∇²h) makes of it, by even steps of the depth that is left. Rims go before bowls.
const std::array<CraterProfile, kCraterStates>& CraterProfiles();

/// The index of the profile whose depth is nearest to `share` of the fresh one.
int CraterState(double share);

}  // namespace regolith
