// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/live_state.h"

#include <cmath>

#include "regolith/imu/propagation.h"

namespace regolith {
namespace {

constexpr double kSmoothing = 0.2;  // s, after which a third of a correction is still to be taken
constexpr double kLongestMemory = 5.0;  // s of samples

}  // namespace

void LiveState::AddImu(const ImuSample& sample) {
  if (!samples_.empty() && sample.time <= samples_.back().time) return;
  samples_.push_back(sample);
  while (SecondsBetween(samples_.front().time, sample.time) > kLongestMemory) samples_.pop_front();
  if (!moved_ || samples_.size() < 2) return;
  const ImuSample& before = samples_[samples_.size() - 2];
  MoveOn(before, sample);
  T_moved_shown_ = ExpSe3(LogSe3(T_moved_shown_) *
                          std::exp(-SecondsBetween(before.time, sample.time) / kSmoothing));
}

void LiveState::MoveOn(const ImuSample& from, const ImuSample& to) {
  if (to.time <= moved_->state.time) return;
  const ImuSample start =
      from.time < moved_->state.time ? InterpolateSample(from, to, moved_->state.time) : from;
  moved_->state = Propagate(moved_->state, start, to, moved_->gravity_world);
}

void LiveState::Correct(const InertialState& corrected) {
  const std::optional<NavState> shown = state();
  moved_ = corrected;
  while (samples_.size() > 1 && samples_[1].time <= corrected.state.time) samples_.pop_front();
  for (size_t i = 1; i < samples_.size(); ++i) MoveOn(samples_[i - 1], samples_[i]);
  if (shown && shown->time == moved_->state.time) {
    T_moved_shown_ = moved_->state.T_world_imu.Inverse() * shown->T_world_imu;
  }
}

std::optional<NavState> LiveState::state() const {
  if (!moved_) return std::nullopt;
  NavState shown = moved_->state;
  shown.T_world_imu = shown.T_world_imu * T_moved_shown_;
  return shown;
}

}  // namespace regolith
