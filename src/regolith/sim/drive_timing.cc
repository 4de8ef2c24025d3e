// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/drive_timing.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/random.h"
#include "regolith/sim/route_layout.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kTableStep = 0.02;    // s
constexpr double kShortestTurn = 1.0;  // s
constexpr double kLeastTurn = 1e-3;    // rad; less is no turn
constexpr double kTurnRamp = 0.35;     // share of a point turn until its peak rate, and after it

double SmoothStep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}

// The part of a point turn that is done when `share` of its time is over: the rate rises and falls
// as raised cosines, and stays at its peak between them.
double TurnProgress(double share) {
  if (share > 0.5) return 1.0 - TurnProgress(1.0 - share);
  const double ramp = std::min(share, kTurnRamp);
  const double rising = 0.5 * (ramp - kTurnRamp / M_PI * std::sin(M_PI * ramp / kTurnRamp));
  return (rising + share - ramp) / (1.0 - kTurnRamp);
}

// Speed over one leg: a ramp, gentle waves about the mean, a ramp.
class LegTiming {
 public:
  LegTiming(const DriveOptions& options, double length, double phase)
      : speed_(options.speed), phase_(phase) {
    // The distance grows with the duration, so bisection finds it.
    double low = 2.0 * kRamp;
    double high = low + 2.0 * length / options.speed;
    for (int i = 0; i < 50; ++i) {
      duration_ = 0.5 * (low + high);
      (Integrate(nullptr) > length ? high : low) = duration_;
    }
    const double last = Integrate(&distances_);
    for (double& distance : distances_) distance *= length / last;
  }

  double duration() const { return duration_; }

  double SpeedAt(double time) const {
    const double ramp = SmoothStep(time / kRamp) * SmoothStep((duration_ - time) / kRamp);
    return speed_ * (kMeanOfNominal + kSpeedWaves * std::sin(0.9 * time + phase_)) * ramp;
  }

  double DistanceAt(double time) const {
    const double place = std::clamp(time / kTableStep, 0.0, static_cast<double>(steps()));
    const auto index = std::min(static_cast<size_t>(place), distances_.size() - 2);
    const double fraction = std::min(place - static_cast<double>(index), 1.0);
    return distances_[index] + fraction * (distances_[index + 1] - distances_[index]);
  }

 private:
  size_t steps() const { return static_cast<size_t>(std::ceil(duration_ / kTableStep)); }

  double Integrate(std::vector<double>* table) const {
    double distance = 0.0;
    if (table != nullptr) table->push_back(0.0);
    for (size_t i = 0; i < steps(); ++i) {
      distance += kTableStep * SpeedAt((static_cast<double>(i) + 0.5) * kTableStep);
      if (table != nullptr) table->push_back(distance);
    }
    return distance;
  }

  double speed_;
  double phase_;
  double duration_ = 0.0;
  std::vector<double> distances_;
};

class Timeline {
 public:
  Timeline(double duration, double interval) : duration_(duration), interval_(interval) {}

  bool full() const { return time(poses_.size()) > duration_; }

  // `at` gives the pose at a time since the part's start.
  template <typename At>
  void Add(double part_duration, const At& at) {
    while (!full() && time(poses_.size()) < start_ + part_duration) {
      poses_.push_back(at(time(poses_.size()) - start_));
    }
    start_ += part_duration;
  }

  std::vector<PlanarPose> Finish(const PlanarPose& rest) {
    while (!full()) poses_.push_back(rest);
    return std::move(poses_);
  }

 private:
  double time(size_t index) const { return static_cast<double>(index) * interval_; }

  double duration_;
  double interval_;
  double start_ = 0.0;
  std::vector<PlanarPose> poses_;
};

void AddTurn(double angle, const DriveOptions& options, PlanarPose* rest, Timeline* timeline) {
  const double duration = TurnDuration(options, angle);
  if (duration == 0.0) return;
  timeline->Add(duration, [&](double t) {
    PlanarPose pose = *rest;
    pose.yaw += angle * TurnProgress(t / duration);
    return pose;
  });
  rest->yaw += angle;
}

}  // namespace

double TurnDuration(const DriveOptions& options, double angle) {
  if (std::abs(angle) < kLeastTurn) return 0.0;
  const double peak = options.turn_rate_deg * kDegree;
  return std::max(std::abs(angle) / ((1.0 - kTurnRamp) * peak), kShortestTurn);
}

double LegDuration(const DriveOptions& options, double length) {
  return length / (kMeanOfNominal * options.speed) + kRamp;
}

std::vector<PlanarPose> TimeDrive(const DriveOptions& options, uint64_t seed,
                                  const std::vector<LegCurve>& legs, double duration,
                                  double interval) {
  Random random(seed, "drive");
  // A pose beyond the end, so that the motion is the same for any duration.
  Timeline timeline(duration + interval, interval);
  PlanarPose rest;
  rest.position = legs.front().At(0.0).position;
  const auto resting = [&rest](double) { return rest; };
  timeline.Add(options.rest, resting);
  for (size_t i = 0; i < legs.size() && !timeline.full(); ++i) {
    const LegCurve& leg = legs[i];
    const double turn = std::remainder(leg.At(0.0).yaw - rest.yaw, 2.0 * M_PI);
    if (i > 0) timeline.Add(options.stop, resting);
    AddTurn(turn, options, &rest, &timeline);
    timeline.Add(options.stop, resting);
    const LegTiming timing(options, leg.length(), random.Uniform(0.0, 2.0 * M_PI));
    PlanarPose pose = rest;
    const auto driving = [&](double t) {
      const LegCurve::Sample sample = leg.At(timing.DistanceAt(t));
      pose.position = sample.position;
      pose.yaw += std::remainder(sample.yaw - pose.yaw, 2.0 * M_PI);
      pose.speed = timing.SpeedAt(t);
      return pose;
    };
    timeline.Add(timing.duration(), driving);
    rest = driving(timing.duration());
    rest.speed = 0.0;
  }
  return timeline.Finish(rest);
}

}  // namespace regolith
