// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/imu/propagation.h"

#include <algorithm>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {

NavState Propagate(const NavState& state, const ImuSample& from, const ImuSample& to,
                   const Eigen::Vector3d& gravity_world) {
  REGOLITH_CHECK(from.time < to.time, "samples at ", from.time, " and ", to.time);
  const double dt = SecondsBetween(from.time, to.time);
  const Eigen::Vector3d rate =
      0.5 * (from.angular_velocity + to.angular_velocity) - state.gyro_bias;
  NavState next = state;
  next.time = to.time;
  next.T_world_imu.rotation = (state.T_world_imu.rotation * ExpSo3(dt * rate)).normalized();
  const Eigen::Vector3d acceleration_world =
      0.5 * (state.T_world_imu.rotation * (from.specific_force - state.accelerometer_bias) +
             next.T_world_imu.rotation * (to.specific_force - state.accelerometer_bias)) +
      gravity_world;
  next.v_world_imu += dt * acceleration_world;
  next.T_world_imu.translation += dt * state.v_world_imu + 0.5 * dt * dt * acceleration_world;
  return next;
}

NavState PropagateTo(NavState state, Span<const ImuSample> samples, TimeNs end,
                     const Eigen::Vector3d& gravity_world) {
  const std::vector<ImuSample> steps = SamplesBetween(samples, state.time, end);
  for (size_t i = 1; i < steps.size(); ++i) {
    if (steps[i].time <= steps[i - 1].time) continue;
    state = Propagate(state, steps[i - 1], steps[i], gravity_world);
  }
  return state;
}

ImuSample InterpolateSample(const ImuSample& from, const ImuSample& to, TimeNs time) {
  const double span = SecondsBetween(from.time, to.time);
  const double fraction = span > 0.0 ? SecondsBetween(from.time, time) / span : 0.0;
  ImuSample sample;
  sample.time = time;
  sample.angular_velocity =
      from.angular_velocity + fraction * (to.angular_velocity - from.angular_velocity);
  sample.specific_force =
      from.specific_force + fraction * (to.specific_force - from.specific_force);
  return sample;
}

namespace {

ImuSample SampleAt(Span<const ImuSample> samples, const ImuSample* later, TimeNs time) {
  const ImuSample& to = later == samples.end() ? samples.back() : *later;
  const ImuSample& from = later == samples.begin() ? samples.front() : *(later - 1);
  if (time <= from.time || time >= to.time) {
    ImuSample held = time <= from.time ? from : to;
    held.time = time;
    return held;
  }
  return InterpolateSample(from, to, time);
}

}  // namespace

std::vector<ImuSample> SamplesBetween(Span<const ImuSample> samples, TimeNs start, TimeNs end) {
  REGOLITH_CHECK(start < end, "from ", start, " to ", end);
  std::vector<ImuSample> between;
  if (samples.empty()) return between;
  const auto is_later = [](TimeNs time, const ImuSample& sample) { return time < sample.time; };
  const auto is_earlier = [](const ImuSample& sample, TimeNs time) { return sample.time < time; };
  const ImuSample* first = std::upper_bound(samples.begin(), samples.end(), start, is_later);
  const ImuSample* last = std::lower_bound(first, samples.end(), end, is_earlier);
  between.reserve(static_cast<size_t>(last - first) + 2);
  between.push_back(SampleAt(samples, first, start));
  between.insert(between.end(), first, last);
  between.push_back(SampleAt(samples, last, end));
  return between;
}

}  // namespace regolith
