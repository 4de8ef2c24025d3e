// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/planar_path.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kRamp = 1.0;           // s from rest to speed
constexpr double kFastest = 1.2;        // of the nominal speed
constexpr double kMeanOfNominal = 1.1;  // legs run a little faster: ramps and stops cost time
constexpr double kSpeedWaves = 0.1;
constexpr int kSubsteps = 10;

struct Rates {
  double speed = 0.0;     // m/s
  double yaw_rate = 0.0;  // rad/s
};

double SmoothStep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}

// One stretch between two rests: driving, resting, turning on the spot, resting.
class Stretch {
 public:
  Stretch(const DriveOptions& options, double start, Random* random)
      : options_(options), start_(start) {
    bend_ = options.curvature * random->Uniform(-1.0, 1.0);
    bend_wave_ = options.curvature * random->Uniform(0.5, 1.0);
    bend_period_ = random->Uniform(9.0, 15.0);
    phase_ = random->Uniform(0.0, 2.0 * M_PI);
    turn_ = options.turn_deg * kDegree * (random->Uniform() < 0.5 ? -1.0 : 1.0);
    // A raised cosine has its peak at twice its mean.
    turn_duration_ = std::max(2.0 * options.turn_deg / options.turn_rate_deg, 1e-3);
  }

  double end() const {
    return start_ + options_.leg_duration + turn_duration_ + 2.0 * options_.stop;
  }

  Rates At(double time) const {
    Rates rates;
    const double driving = time - start_;
    if (driving < options_.leg_duration) {
      const double ramp =
          SmoothStep(driving / kRamp) * SmoothStep((options_.leg_duration - driving) / kRamp);
      const double wave = kMeanOfNominal + kSpeedWaves * std::sin(0.9 * driving + phase_);
      rates.speed = options_.speed * std::min(wave, kFastest) * ramp;
      const double bend =
          bend_ + bend_wave_ * std::sin(2.0 * M_PI * driving / bend_period_ + phase_);
      rates.yaw_rate = rates.speed * std::clamp(bend, -options_.curvature, options_.curvature);
      return rates;
    }
    const double turning = driving - options_.leg_duration - options_.stop;
    if (turning > 0.0 && turning < turn_duration_) {
      rates.yaw_rate =
          turn_ / turn_duration_ * (1.0 - std::cos(2.0 * M_PI * turning / turn_duration_));
    }
    return rates;
  }

 private:
  DriveOptions options_;
  double start_;
  double bend_;
  double bend_wave_;
  double bend_period_;
  double phase_;
  double turn_;
  double turn_duration_;
};

}  // namespace

std::vector<PlanarPose> PlanPath(const DriveOptions& options, uint64_t seed, double duration,
                                 double interval) {
  Random random(seed, "path");
  Stretch stretch(options, options.rest, &random);
  const double step = interval / kSubsteps;
  const auto count = static_cast<int>(std::ceil(duration / interval)) + 1;
  std::vector<PlanarPose> poses;
  PlanarPose pose;
  for (int i = 0; i < count; ++i) {
    poses.push_back(pose);
    for (int k = 0; k < kSubsteps; ++k) {
      const double time = i * interval + (k + 0.5) * step;
      if (time < options.rest) continue;
      while (time >= stretch.end()) stretch = Stretch(options, stretch.end(), &random);
      const Rates rates = stretch.At(time);
      const double yaw = pose.yaw + 0.5 * step * rates.yaw_rate;
      pose.position += step * rates.speed * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
      pose.yaw += step * rates.yaw_rate;
      pose.speed = rates.speed;
    }
  }
  return poses;
}

}  // namespace regolith
