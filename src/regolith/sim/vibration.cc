// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/vibration.h"

#include <cmath>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr int kWaves = 12;  // an axis

}  // namespace

Vibration::Vibration(const VibrationOptions& options, uint64_t seed) {
  Random random(seed, "vibration");
  // Equal parts of the RMS: a sum of n sinusoids of amplitude a has the RMS a · sqrt(n / 2).
  const double share = std::sqrt(2.0 / kWaves);
  const double band = (options.max_frequency - options.min_frequency) / kWaves;
  for (int axis = 0; axis < 6; ++axis) {
    for (int i = 0; i < kWaves; ++i) {
      Wave wave;
      wave.angular_frequency = 2.0 * M_PI * (options.min_frequency + band * (i + random.Uniform()));
      const double w = wave.angular_frequency;
      wave.amplitude =
          axis < 3 ? share * options.acceleration / (w * w) : share * options.angular_rate / w;
      wave.phase = random.Uniform(0.0, 2.0 * M_PI);
      waves_[axis].push_back(wave);
    }
  }
}

Vibration::Value Vibration::At(double time, double envelope, double envelope_first,
                               double envelope_second) const {
  Value result{Vector6::Zero(), Vector6::Zero(), Vector6::Zero()};
  if (envelope == 0.0 && envelope_first == 0.0 && envelope_second == 0.0) return result;
  for (int axis = 0; axis < 6; ++axis) {
    double value = 0.0;
    double first = 0.0;
    double second = 0.0;
    for (const Wave& wave : waves_[axis]) {
      const double w = wave.angular_frequency;
      const double sine = std::sin(w * time + wave.phase);
      const double cosine = std::cos(w * time + wave.phase);
      value += wave.amplitude * sine;
      first += wave.amplitude * w * cosine;
      second -= wave.amplitude * w * w * sine;
    }
    // Product rule.
    result.value[axis] = envelope * value;
    result.first[axis] = envelope_first * value + envelope * first;
    result.second[axis] =
        envelope_second * value + 2.0 * envelope_first * first + envelope * second;
  }
  return result;
}

}  // namespace regolith
