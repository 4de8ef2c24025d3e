// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/core/span.h"
#include "regolith/core/time.h"
#include "regolith/geometry/nav_state.h"
#include "regolith/sensor/imu_noise.h"
#include "regolith/sensor/imu_sample.h"

namespace regolith {

using Vector15d = Eigen::Matrix<double, 15, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Matrix15d = Eigen::Matrix<double, 15, 15>;
using Matrix93d = Eigen::Matrix<double, 9, 3>;

/// The residual between two states, in the error order of NavState: [rotation (rad), position (m),
/// velocity (m/s), gyro bias (rad/s), accelerometer bias (m/s²)], the first three in the frame of
/// the first state's imu.
struct ImuResidual {
  Vector15d value = Vector15d::Zero();
  Matrix15d jacobian_from = Matrix15d::Zero();  ///< by the error of the first state
  Matrix15d jacobian_to = Matrix15d::Zero();    ///< by the error of the second state
};

/// Motion between two times from inertial measurements alone, free of the state at its start
/// (Forster, Carlone, Dellaert, Scaramuzza 2017, "On-manifold preintegration for real-time
/// visual-inertial odometry"), with the midpoint rule of Propagate().
class ImuPreintegration {
 public:
  /// Biases (rad/s, m/s²) at which the motion is linearised.
  ImuPreintegration(const ImuNoise& noise, const Eigen::Vector3d& gyro_bias,
                    const Eigen::Vector3d& accelerometer_bias);

  /// Adds the motion between two samples. Throws CheckError unless `to` is later than `from` and
  /// `from` has the time where the last call ended.
  void Integrate(const ImuSample& from, const ImuSample& to);
  void Integrate(Span<const ImuSample> samples);

  TimeNs start_time() const { return start_time_; }
  TimeNs end_time() const { return end_time_; }
  /// s
  double duration() const { return SecondsBetween(start_time_, end_time_); }

  /// At the linearisation biases, in the first imu frame, gravity left out.
  const Eigen::Quaterniond& delta_rotation() const { return delta_rotation_; }
  const Eigen::Vector3d& delta_position() const { return delta_position_; }
  const Eigen::Vector3d& delta_velocity() const { return delta_velocity_; }
  const Eigen::Vector3d& gyro_bias() const { return gyro_bias_; }
  const Eigen::Vector3d& accelerometer_bias() const { return accelerometer_bias_; }

  /// Of [rotation (right), position, velocity] by the biases.
  const Matrix93d& jacobian_gyro_bias() const { return jacobian_gyro_bias_; }
  const Matrix93d& jacobian_accelerometer_bias() const { return jacobian_accelerometer_bias_; }

  /// Of [rotation, position, velocity], from the white noise of the samples.
  const Matrix9d& covariance() const { return covariance_; }
  /// With the random walk of the biases in the last six rows; the weight of the residual.
  Matrix15d FullCovariance() const;

  /// The state at the end from the state at the start, corrected to the state's own biases to first
  /// order.
  NavState Predict(const NavState& from, const Eigen::Vector3d& gravity_world) const;

  /// Forster et al. 2017, equation 45, for states perturbed as in NavState.
  ImuResidual Residual(const NavState& from, const NavState& to,
                       const Eigen::Vector3d& gravity_world) const;

 private:
  struct Delta {
    Eigen::Quaterniond rotation;
    Eigen::Vector3d position;
    Eigen::Vector3d velocity;
    Eigen::Vector3d rotation_correction;  ///< rad, right of the delta at the linearisation biases
  };
  Delta CorrectedDelta(const NavState& from) const;
  void FillJacobians(const Delta& delta, const NavState& from, const NavState& to,
                     ImuResidual* residual) const;

  ImuNoise noise_;
  Eigen::Vector3d gyro_bias_;
  Eigen::Vector3d accelerometer_bias_;
  bool is_empty_ = true;
  TimeNs start_time_ = 0;
  TimeNs end_time_ = 0;
  Eigen::Quaterniond delta_rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d delta_position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d delta_velocity_ = Eigen::Vector3d::Zero();
  Matrix93d jacobian_gyro_bias_ = Matrix93d::Zero();
  Matrix93d jacobian_accelerometer_bias_ = Matrix93d::Zero();
  Matrix9d covariance_ = Matrix9d::Zero();
};

}  // namespace regolith
