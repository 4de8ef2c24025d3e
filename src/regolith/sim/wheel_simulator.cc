// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/wheel_simulator.h"

#include <algorithm>
#include <cmath>

#include "regolith/sim/rover_geometry.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kTableStep = 5.0 * kDegree;
constexpr double kSlipMemory = 1.0;  // s, over which the ground's grip changes
constexpr double kMostSlip = 0.9;

// 1 in a point turn, 0 in straight driving: the wheels' sideways share of the motion.
double TurnShare(double speed, double yaw_rate) {
  const double sideways = std::abs(yaw_rate) * kHalfTrack;
  const double total = sideways + 4.0 * std::abs(speed);
  return total > 0.0 ? sideways / total : 0.0;
}

}  // namespace

double MeanSlip(const WheelOptions& options, double slope) {
  const double place = std::min(std::abs(slope) / kTableStep, 3.0);
  const auto index = std::min(static_cast<size_t>(place), size_t{2});
  const double fraction = place - static_cast<double>(index);
  const double uphill =
      options.slip[index] + fraction * (options.slip[index + 1] - options.slip[index]);
  if (slope >= 0.0) return uphill;
  return options.slip[0] - 0.5 * (uphill - options.slip[0]);
}

WheelSimulator::WheelSimulator(const WheelOptions& options, uint64_t seed)
    : options_(options), random_(seed, "wheels") {
  radius_scale_ = 1.0 + (random_.Uniform() < 0.5 ? -1.0 : 1.0) * options.radius_error;
  turn_scale_ = options.turn_error * (random_.Uniform() < 0.5 ? -1.0 : 1.0);
}

WheelOdometry WheelSimulator::Measure(const MotionState& motion) {
  const double interval = 1.0 / options_.rate;
  const Eigen::Quaterniond R_imu_world = motion.T_world_imu.rotation.conjugate();
  const Eigen::Vector3d v_base = R_imu_world * motion.v_world_imu -
                                 motion.angular_velocity_imu.cross(BaseFromImu().translation);
  const Eigen::Vector3d ahead = motion.T_world_imu.rotation * Eigen::Vector3d::UnitX();
  const double slope = std::asin(std::clamp(ahead.z(), -1.0, 1.0));
  // A Gauss–Markov process of unit variance.
  const double keep = std::exp(-interval / kSlipMemory);
  slip_deviation_ = keep * slip_deviation_ + std::sqrt(1.0 - keep * keep) * random_.Gaussian();
  const double slip = std::min(
      MeanSlip(options_, slope) * (1.0 + options_.slip_spread * slip_deviation_), kMostSlip);
  const double speed = radius_scale_ * v_base.x() / (1.0 - slip);
  const double true_yaw_rate = motion.angular_velocity_imu.z();
  const double yaw_rate =
      true_yaw_rate * (1.0 + turn_scale_ * TurnShare(v_base.x(), true_yaw_rate));
  if (started_) {
    // Trapezoidal.
    const double mean_speed = 0.5 * (speed + previous_speed_);
    const double mean_yaw_rate = 0.5 * (yaw_rate + previous_yaw_rate_);
    const double heading = yaw_ + 0.5 * interval * mean_yaw_rate;
    position_ += interval * mean_speed * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    yaw_ += interval * mean_yaw_rate;
  }
  started_ = true;
  previous_speed_ = speed;
  previous_yaw_rate_ = yaw_rate;
  WheelOdometry odometry;
  odometry.T_odom_base = SE3(Eigen::Quaterniond(Eigen::AngleAxisd(yaw_, Eigen::Vector3d::UnitZ())),
                             Eigen::Vector3d(position_.x(), position_.y(), 0.0));
  odometry.linear_velocity_base = Eigen::Vector3d(speed, 0.0, 0.0);
  odometry.angular_velocity_base = Eigen::Vector3d(0.0, 0.0, yaw_rate);
  return odometry;
}

}  // namespace regolith
