// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/geometry/nav_state.h"
#include "regolith/imu/rest_detection.h"
#include "regolith/lio/inertial_filter_options.h"
#include "regolith/sensor/imu_noise.h"
#include "regolith/sensor/imu_sample.h"
#include "regolith/sensor/wheel_odometry.h"

namespace regolith {

/// Error-state filter of one IMU (Solà 2017, "Quaternion kinematics for the error-state Kalman
/// filter"; Xu et al. 2022 for gravity as a state). Error order: [rotation (right), position,
/// velocity, gyro bias, accelerometer bias, gravity, wheel slip], SI units. The world's z axis
/// points up as far as the first samples tell; what the accelerometer's bias hides of that is
/// estimated as the direction of gravity, whose magnitude is known.
class InertialFilter {
 public:
  static constexpr int kSize = 19;
  using Covariance = Eigen::Matrix<double, kSize, kSize>;

  /// Starts from the statistics of the first samples. `gravity`: magnitude, m/s².
  InertialFilter(TimeNs time, const RestReport& first_samples, double gravity,
                 const ImuNoise& noise, const InertialFilterOptions& options);

  /// Restates a start in a world that is there already: pose and velocity (1 σ, m/s) are known in
  /// it, and gravity lies where the first samples felt it.
  void MoveInto(const SE3& T_world_imu, const Eigen::Vector3d& v_world_imu, double velocity_sigma);

  /// Lets a new world begin at the present pose, which is exact in it, with the axes and the origin
  /// that the old one is thought to have. Returns how far the new one may lie from the old: the
  /// pose's covariance until now.
  Matrix6d BeginWorld();

  const NavState& state() const { return state_; }
  const Eigen::Vector3d& gravity_world() const { return gravity_world_; }
  /// Share by which the wheels say more than the way that was gone.
  double wheel_slip() const { return wheel_slip_; }
  const Covariance& covariance() const { return covariance_; }
  Matrix6d PoseCovariance() const { return covariance_.topLeftCorner<6, 6>(); }

  /// Moves the state from one sample to the next.
  void Propagate(const ImuSample& from, const ImuSample& to);

  /// Moves the state over time without samples (a gap): it turns on at the rate between the last
  /// two poses absorbed, as long as these are not old, and keeps its speed, with growing doubt.
  /// What the pose then learns says nothing of biases, gravity and slip any more.
  void PropagateBlindly(TimeNs time);
  /// Of PropagateBlindly, rad/s.
  Eigen::Vector3d BlindRate() const;

  /// Takes in a pose that was estimated with this filter's pose as its prior: its mean and
  /// covariance replace the prior's, and everything that is correlated with the pose follows.
  void AbsorbPose(const SE3& T_world_imu, const Matrix6d& covariance);

  /// The velocity that the wheels tell. `rate`: the gyro's, rad/s, at the same time; `is_placed`:
  /// poses tell the rover's whole motion already.
  void AbsorbWheels(const WheelOdometry& wheels, const SE3& T_imu_base, const Eigen::Vector3d& rate,
                    bool is_placed);

  /// A velocity (m/s, IMU's frame) that another sensor tells; `sigma` of each axis.
  void AbsorbVelocity(const Eigen::Vector3d& velocity_imu, double sigma);
  /// Whether such a velocity can be, by all that is known already (95 %). With few features a
  /// camera is sure of speeds that the rover does not have.
  bool CanBe(const Eigen::Vector3d& velocity_imu, double sigma) const;

  /// Zero velocity, and zero rotation so that the mean rate is the gyro's bias.
  void AbsorbRest(const ImuStatistics& samples);

 private:
  /// `caution`: all but the slip learns as if the variances were that many times larger (a partial
  /// update; Brink 2017).
  template <int kRows>
  void Absorb(const Eigen::Matrix<double, kRows, kSize>& jacobian,
              const Eigen::Matrix<double, kRows, 1>& innovation,
              const Eigen::Matrix<double, kRows, 1>& variances, double caution = 1.0);
  void Correct(const Eigen::Matrix<double, kSize, 1>& error);

  struct VelocityInnovation {
    Eigen::Matrix<double, 3, kSize> jacobian = Eigen::Matrix<double, 3, kSize>::Zero();
    Eigen::Vector3d value;
  };
  /// What a velocity has that the state has not.
  VelocityInnovation Compare(const Eigen::Vector3d& velocity_imu) const;

  NavState state_;
  TimeNs last_pose_time_ = 0;  ///< of the last pose absorbed, with …
  Eigen::Quaterniond last_rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();  ///< … the turn from the one before, rad/s
  Eigen::Vector3d gravity_world_;
  double wheel_slip_ = 0.0;
  Covariance covariance_ = Covariance::Zero();
  double gravity_;
  ImuNoise noise_;
  InertialFilterOptions options_;
};

}  // namespace regolith
