// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/inertial_tracker.h"

#include <algorithm>

#include "regolith/core/error.h"
#include "regolith/imu/propagation.h"

namespace regolith {
namespace {

constexpr double kEarthGravity = 9.81;
// How long a scan that told all directions counts beside the wheels.
constexpr double kPlaced = 0.5;  // s
// Of a velocity that two scans tell, 1 σ.
constexpr double kScanVelocity = 0.3;  // m/s
// A sensor that told a velocity that cannot be was on its way there before, and is not back at
// once.
constexpr double kDistrust = 5.0;  // s, as long as its window of keyframes may hold it

}  // namespace

InertialTracker::InertialTracker(const LidarOdometryOptions& options, const RigCalibration& rig)
    : options_(options), rig_(rig) {
  REGOLITH_CHECK(rig.imu.has_value(), "the rig has no IMU");
}

void InertialTracker::AddImu(const ImuSample& sample) {
  if (!samples_.empty()) {
    const double step = SecondsBetween(samples_.back().time, sample.time);
    if (step <= 0.0) return;
    if (step > options_.max_imu_gap) {
      gaps_.push_back({samples_.back().time, sample.time});
      ++gap_count_;
      longest_gap_ = std::max(longest_gap_, step);
    }
  }
  samples_.push_back(sample);
}

void InertialTracker::AddWheels(const WheelOdometry& odometry) { wheels_.push_back(odometry); }

void InertialTracker::CheckGravity(const ImuStatistics& statistics) const {
  const double force = statistics.mean_specific_force.norm();
  const double ratio = force / rig_.gravity;
  if (ratio > 0.5 && ratio < 2.0) return;
  const double in_g = ratio * kEarthGravity;
  throw InputError(
      rig_.imu->topic,
      Concatenate("mean specific force at the start is ", force, ", but gravity in the rig is ",
                  rig_.gravity, " m/s²; ",
                  in_g > 0.8 && in_g < 1.2 ? "the samples look to be in g, expected m/s²"
                                           : "check `gravity` in the rig and the IMU's units"));
}

void InertialTracker::TryToStart(bool all) {
  if (state_ != State::kWaiting || samples_.size() < 2) return;
  const double span = SecondsBetween(samples_.front().time, samples_.back().time);
  if (span < options_.initialization_window && !all) return;
  const std::optional<RestReport> report = FirstSamples();
  if (!report) return;
  if (!report->at_rest) {
    start_notice_ = "the recording does not start at rest (" + report->reason +
                    "): the first attitude, velocity and biases are rough";
  }
  filter_.emplace(samples_.front().time, *report, rig_.gravity, rig_.imu->noise, options_.filter);
  state_ = State::kRunning;
}

bool InertialTracker::Join(const StampedPose& pose, const Eigen::Vector3d& v_world_imu) {
  if (state_ != State::kWaiting || samples_.empty()) return false;
  const TimeNs needed = AddSeconds(samples_.back().time, -options_.initialization_window);
  if (samples_.front().time > std::min(needed, pose.time) || samples_.back().time < pose.time) {
    return false;
  }
  while (samples_[1].time <= std::min(needed, pose.time)) samples_.erase(samples_.begin());
  std::optional<RestReport> report = FirstSamples();
  if (!report) return false;
  report->at_rest = false;  // a steady drive is as still as rest is
  filter_.emplace(pose.time, *report, rig_.gravity, rig_.imu->noise, options_.filter);
  filter_->MoveInto(pose.T_world_body, v_world_imu, kScanVelocity);
  state_ = State::kRunning;
  return true;
}

/// What the samples say of gravity and rest. Nothing, and `state_` kUnusable, where they come too
/// slowly; throws InputError where they cannot be what the rig says.
std::optional<RestReport> InertialTracker::FirstSamples() {
  const double span = SecondsBetween(samples_.front().time, samples_.back().time);
  const double rate = static_cast<double>(samples_.size() - 1) / span;
  if (rate < options_.min_imu_rate) {
    if (!options_.lidar) {
      throw InputError(rig_.imu->topic,
                       Concatenate("comes at ", rate, " Hz, expected at least ",
                                   options_.min_imu_rate, "; set lio.lidar=true to go without it"));
    }
    state_ = State::kUnusable;
    start_notice_ = Concatenate("the IMU comes at ", rate, " Hz, below ", options_.min_imu_rate,
                                " Hz: it is not used, and the world is not level");
    return std::nullopt;
  }
  RestReport report = DetectRest(samples_, rig_.gravity, options_.rest);
  CheckGravity(report.statistics);
  return report;
}

void InertialTracker::Step(const ImuSample& from, const ImuSample& to) {
  const bool in_gap = std::any_of(gaps_.begin(), gaps_.end(), [&](const Gap& gap) {
    return from.time >= gap.begin && to.time <= gap.end;
  });
  const bool is_blind = in_gap || from.time >= samples_.back().time;
  if (is_blind) {
    filter_->PropagateBlindly(to.time);
  } else {
    filter_->Propagate(from, to);
  }
  const Eigen::Vector3d rate =
      is_blind ? filter_->BlindRate() + filter_->state().gyro_bias : to.angular_velocity;
  for (; !wheels_.empty() && wheels_.front().time <= to.time; wheels_.pop_front()) {
    if (wheels_.front().time <= from.time) continue;
    const bool is_placed = placed_ && SecondsBetween(*placed_, to.time) < kPlaced;
    filter_->AbsorbWheels(wheels_.front(), rig_.wheels->T_imu_base, rate, is_placed);
  }
  for (; !velocities_.empty() && velocities_.front().time <= to.time; velocities_.pop_front()) {
    if (velocities_.front().time <= from.time) continue;
    const BodyVelocity& told = velocities_.front();
    if (!filter_->CanBe(told.velocity_imu, told.sigma)) {
      distrusted_until_ = AddSeconds(told.time, kDistrust);
    }
    if (told.time < distrusted_until_) {
      ++distrusted_count_;
      continue;
    }
    filter_->AbsorbVelocity(told.velocity_imu, told.sigma);
    took_velocities_ = true;
  }
}

std::vector<StampedPose> InertialTracker::PropagateTo(TimeNs end) {
  took_velocities_ = false;
  std::vector<StampedPose> motion = {{filter_->state().time, filter_->state().T_world_imu}};
  if (end <= filter_->state().time) return motion;
  const std::vector<ImuSample> steps = SamplesBetween(samples_, filter_->state().time, end);
  for (size_t i = 1; i < steps.size(); ++i) {
    if (steps[i].time <= steps[i - 1].time) continue;
    Step(steps[i - 1], steps[i]);
    motion.push_back({filter_->state().time, filter_->state().T_world_imu});
  }
  return motion;
}

bool InertialTracker::AbsorbRest() {
  const TimeNs time = filter_->state().time;
  if (filter_->state().v_world_imu.norm() > options_.rest_max_speed) return false;
  const TimeNs begin = AddSeconds(time, -options_.rest_window);
  if (samples_.front().time > begin || samples_.back().time < time) return false;
  const std::vector<ImuSample> window = SamplesBetween(samples_, begin, time);
  const RestReport report = DetectRest(window, rig_.gravity, options_.rest);
  if (!report.at_rest) return false;
  // A slow turn is as still as rest is: the rate has to be the bias.
  const Eigen::Vector3d rate = report.statistics.mean_rate - filter_->state().gyro_bias;
  if (rate.norm() > options_.rest_max_rate) return false;
  // Windows that overlap would count their samples twice.
  if (SecondsBetween(last_rest_, time) >= options_.rest_window) {
    filter_->AbsorbRest(report.statistics);
    last_rest_ = time;
  }
  return true;
}

void InertialTracker::Forget() {
  const TimeNs needed = AddSeconds(filter_->state().time, -2.0 * options_.rest_window);
  const auto first =
      std::lower_bound(samples_.begin(), samples_.end(), needed,
                       [](const ImuSample& sample, TimeNs time) { return sample.time < time; });
  if (first != samples_.end()) samples_.erase(samples_.begin(), first);
  while (!gaps_.empty() && gaps_.front().end < filter_->state().time) gaps_.pop_front();
}

std::vector<std::string> InertialTracker::Notices() const {
  std::vector<std::string> notices;
  if (!start_notice_.empty()) notices.push_back(start_notice_);
  if (gap_count_ > 0) {
    notices.push_back(Concatenate(gap_count_, " gaps in the IMU, the longest ", longest_gap_,
                                  " s, were bridged by constant velocity"));
  }
  if (distrusted_count_ > 0) {
    notices.push_back(Concatenate(distrusted_count_,
                                  " velocities of the camera were left out: they cannot be by what "
                                  "scans and IMU say, or came less than ",
                                  kDistrust, " s after one that cannot"));
  }
  return notices;
}

}  // namespace regolith
