// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/crater_profile.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace regolith {
namespace {

constexpr int kPerRadius = 64;              // nodes of the diffusion's grid
constexpr int kNodes = 5 * kPerRadius;      // far enough for its border not to matter
constexpr double kTimeStep = 0.2;           // of the square of the node distance; stable below .25
constexpr double kRimHeight = 0.036;        // diameters
constexpr double kTaperStart = 1.8;         // radii
constexpr double kFreshSmoothing = 6.0e-4;  // κt / R²: rounds kinks over some .05 radii
constexpr double kShallowest = 1.0 / kCraterStates;

// Height / diameter at x radii. Inside: Fassett and Thomson 2014. Outside: the rim's height falls
// as the cube of the distance (McGetchin et al. 1973).
double FreshHeight(double x) {
  if (x < 0.2) return -0.181;
  if (x < 0.98) return -0.229 + x * (0.228 + x * (0.083 - 0.039 * x));
  if (x < 1.02) return kRimHeight;
  return kRimHeight * std::pow(1.02 / x, 3);
}

// From one to zero where the blanket ends, with no slope at either end.
double Taper(double x) {
  const double t = std::clamp((kCraterReach - x) / (kCraterReach - kTaperStart), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

class Diffusion {
 public:
  Diffusion() : height_(kNodes), next_(kNodes) {
    for (int i = 0; i < kNodes; ++i) {
      height_[static_cast<size_t>(i)] = FreshHeight(static_cast<double>(i) / kPerRadius);
    }
  }

  void Step() {
    for (size_t i = 1; i + 1 < kNodes; ++i) {
      const double second = height_[i + 1] - 2.0 * height_[i] + height_[i - 1];
      const double first = 0.5 * (height_[i + 1] - height_[i - 1]);
      next_[i] = height_[i] + kTimeStep * (second + first / static_cast<double>(i));
    }
    next_[0] = height_[0] + kTimeStep * 4.0 * (height_[1] - height_[0]);
    next_[kNodes - 1] = height_[kNodes - 1];
    height_.swap(next_);
  }

  double Depth() const {
    const auto range = std::minmax_element(height_.begin(), height_.end());
    return *range.second - *range.first;
  }

  double At(double x) const {
    const auto i = std::min(static_cast<size_t>(x * kPerRadius), size_t{kNodes - 2});
    const double share = x * kPerRadius - static_cast<double>(i);
    return (height_[i] + share * (height_[i + 1] - height_[i])) * Taper(x);
  }

 private:
  std::vector<double> height_;  // diameters
  std::vector<double> next_;
};

CraterProfile Sampled(const Diffusion& diffusion, double fresh_depth) {
  CraterProfile profile;
  profile.depth = diffusion.Depth() / fresh_depth;
  constexpr double kStep = kCraterReach / kProfileKnots;
  for (size_t i = 0; i < kProfileKnots; ++i) {
    const double x = kStep * static_cast<double>(i);
    profile.height[i] = static_cast<float>(diffusion.At(x) / diffusion.Depth());
    const double rise = diffusion.At(x + 0.5 * kStep) - diffusion.At(std::abs(x - 0.5 * kStep));
    profile.slope[i] = static_cast<float>(rise / diffusion.Depth());
  }
  return profile;
}

std::array<CraterProfile, kCraterStates> MakeProfiles() {
  Diffusion diffusion;
  for (double time = 0.0; time < kFreshSmoothing; time += kTimeStep / (kPerRadius * kPerRadius)) {
    diffusion.Step();
  }
  const double fresh_depth = diffusion.Depth();
  std::array<CraterProfile, kCraterStates> profiles;
  for (size_t state = 0; state < kCraterStates; ++state) {
    const double share = 1.0 - static_cast<double>(state) * kShallowest;
    while (diffusion.Depth() > share * fresh_depth) diffusion.Step();
    profiles[state] = Sampled(diffusion, fresh_depth);
  }
  return profiles;
}

}  // namespace

const std::array<CraterProfile, kCraterStates>& CraterProfiles() {
  static const std::array<CraterProfile, kCraterStates> kProfiles = MakeProfiles();
  return kProfiles;
}

int CraterState(double share) {
  return std::clamp(static_cast<int>(std::lround((1.0 - share) / kShallowest)), 0,
                    kCraterStates - 1);
}

}  // namespace regolith
