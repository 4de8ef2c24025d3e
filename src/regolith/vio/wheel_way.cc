// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/wheel_way.h"

#include <algorithm>

#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

/// Rotation of the IMU since the first sample, asked for at times that do not decrease.
class TurnSince {
 public:
  TurnSince(Span<const ImuSample> samples, const Eigen::Vector3d& gyro_bias)
      : samples_(samples), gyro_bias_(gyro_bias) {}

  Eigen::Quaterniond At(TimeNs time) {
    while (next_ < samples_.size() && samples_[next_].time <= time) {
      rotation_ = rotation_ * Step(samples_[next_].time);
      reached_ = samples_[next_].time;
      ++next_;
    }
    return rotation_ * Step(std::max(time, reached_));
  }

 private:
  Eigen::Quaterniond Step(TimeNs time) const {
    const size_t last = std::min(next_, samples_.size() - 1);
    const Eigen::Vector3d rate = samples_[last].angular_velocity - gyro_bias_;
    return ExpSo3(rate * SecondsBetween(reached_, time));
  }

  Span<const ImuSample> samples_;
  Eigen::Vector3d gyro_bias_;
  size_t next_ = 1;
  TimeNs reached_ = samples_.front().time;
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
};

}  // namespace

std::optional<WheelWay> IntegrateWheelWay(Span<const WheelOdometry> wheels,
                                          Span<const ImuSample> samples,
                                          const Eigen::Quaterniond& R_imu_base,
                                          const Eigen::Vector3d& gyro_bias) {
  if (samples.size() < 2 || wheels.size() < 2) return std::nullopt;
  const TimeNs start = samples.front().time;
  const TimeNs end = samples.back().time;
  if (wheels.front().time > start || wheels.back().time < end) return std::nullopt;
  TurnSince turn(samples, gyro_bias);
  WheelWay way;
  Eigen::Quaterniond last_turn = Eigen::Quaterniond::Identity();
  for (size_t i = 1; i < wheels.size() && wheels[i - 1].time < end; ++i) {
    const TimeNs from = std::max(wheels[i - 1].time, start);
    const TimeNs to = std::min(wheels[i].time, end);
    if (to <= from) continue;
    const double share =
        SecondsBetween(from, to) / SecondsBetween(wheels[i - 1].time, wheels[i].time);
    const SE3 step = wheels[i - 1].T_odom_base.Inverse() * wheels[i].T_odom_base;
    const Eigen::Quaterniond R_start_now = turn.At(from + (to - from) / 2);
    const Eigen::Quaterniond R_base = R_imu_base.conjugate() * R_start_now * R_imu_base;
    way.way_base += share * (R_base * step.translation);
    way.length += share * step.translation.norm();
    way.angle += AngleBetween(last_turn, R_start_now);
    last_turn = R_start_now;
  }
  return way;
}

}  // namespace regolith
