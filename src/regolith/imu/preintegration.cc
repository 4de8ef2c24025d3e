// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/imu/preintegration.h"

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

// First row of each part in the error order.
constexpr int kRotation = 0;
constexpr int kPosition = 3;
constexpr int kVelocity = 6;
constexpr int kGyroBias = 9;
constexpr int kAccelerometerBias = 12;

double Square(double value) { return value * value; }

/// How one step passes errors on: of the delta before it, of the rate and of the specific force.
struct StepJacobians {
  Matrix9d by_delta = Matrix9d::Identity();
  Matrix93d by_rate = Matrix93d::Zero();
  Matrix93d by_force = Matrix93d::Zero();
};

StepJacobians LinearizeStep(const Eigen::Matrix3d& rotation_before,
                            const Eigen::Matrix3d& rotation_after,
                            const Eigen::Vector3d& rotation_step,
                            const Eigen::Vector3d& force_before, const Eigen::Vector3d& force_after,
                            double dt) {
  const Eigen::Matrix3d step_inverse = rotation_after.transpose() * rotation_before;
  const Eigen::Matrix3d rotation_by_rate = dt * RightJacobianSo3(rotation_step);
  const Eigen::Matrix3d after_by_rotation = rotation_after * Hat(force_after);
  const Eigen::Matrix3d acceleration_by_rotation =
      -0.5 * (rotation_before * Hat(force_before) + after_by_rotation * step_inverse);
  const Eigen::Matrix3d acceleration_by_rate = -0.5 * after_by_rotation * rotation_by_rate;
  const Eigen::Matrix3d acceleration_by_force = 0.5 * (rotation_before + rotation_after);
  const double half_square = 0.5 * dt * dt;

  StepJacobians jacobians;
  jacobians.by_delta.block<3, 3>(kRotation, kRotation) = step_inverse;
  jacobians.by_delta.block<3, 3>(kPosition, kRotation) = half_square * acceleration_by_rotation;
  jacobians.by_delta.block<3, 3>(kPosition, kVelocity) = dt * Eigen::Matrix3d::Identity();
  jacobians.by_delta.block<3, 3>(kVelocity, kRotation) = dt * acceleration_by_rotation;
  jacobians.by_rate.middleRows<3>(kRotation) = rotation_by_rate;
  jacobians.by_rate.middleRows<3>(kPosition) = half_square * acceleration_by_rate;
  jacobians.by_rate.middleRows<3>(kVelocity) = dt * acceleration_by_rate;
  jacobians.by_force.middleRows<3>(kPosition) = half_square * acceleration_by_force;
  jacobians.by_force.middleRows<3>(kVelocity) = dt * acceleration_by_force;
  return jacobians;
}

}  // namespace

ImuPreintegration::ImuPreintegration(const ImuNoise& noise, const Eigen::Vector3d& gyro_bias,
                                     const Eigen::Vector3d& accelerometer_bias)
    : noise_(noise), gyro_bias_(gyro_bias), accelerometer_bias_(accelerometer_bias) {}

void ImuPreintegration::Integrate(const ImuSample& from, const ImuSample& to) {
  REGOLITH_CHECK(from.time < to.time, "samples at ", from.time, " and ", to.time);
  REGOLITH_CHECK(is_empty_ || from.time == end_time_, "sample at ", from.time, " after motion to ",
                 end_time_);
  if (is_empty_) start_time_ = from.time;
  is_empty_ = false;
  end_time_ = to.time;

  const double dt = SecondsBetween(from.time, to.time);
  const Eigen::Vector3d rotation_step =
      dt * (0.5 * (from.angular_velocity + to.angular_velocity) - gyro_bias_);
  const Eigen::Vector3d force_before = from.specific_force - accelerometer_bias_;
  const Eigen::Vector3d force_after = to.specific_force - accelerometer_bias_;
  const Eigen::Quaterniond rotation_after = (delta_rotation_ * ExpSo3(rotation_step)).normalized();
  const StepJacobians step =
      LinearizeStep(delta_rotation_.toRotationMatrix(), rotation_after.toRotationMatrix(),
                    rotation_step, force_before, force_after, dt);

  const Eigen::Vector3d acceleration =
      0.5 * (delta_rotation_ * force_before + rotation_after * force_after);
  delta_position_ += dt * delta_velocity_ + 0.5 * dt * dt * acceleration;
  delta_velocity_ += dt * acceleration;
  delta_rotation_ = rotation_after;

  jacobian_gyro_bias_ = step.by_delta * jacobian_gyro_bias_ - step.by_rate;
  jacobian_accelerometer_bias_ = step.by_delta * jacobian_accelerometer_bias_ - step.by_force;
  // White noise of density σ is, held over dt, a sample of variance σ²/dt.
  covariance_ = step.by_delta * covariance_ * step.by_delta.transpose();
  covariance_ += Square(noise_.gyro_density) / dt * step.by_rate * step.by_rate.transpose();
  covariance_ +=
      Square(noise_.accelerometer_density) / dt * step.by_force * step.by_force.transpose();
}

void ImuPreintegration::Integrate(Span<const ImuSample> samples) {
  for (size_t i = 1; i < samples.size(); ++i) Integrate(samples[i - 1], samples[i]);
}

Matrix15d ImuPreintegration::FullCovariance() const {
  Matrix15d full = Matrix15d::Zero();
  full.topLeftCorner<9, 9>() = covariance_;
  full.diagonal().segment<3>(kGyroBias).setConstant(Square(noise_.gyro_walk) * duration());
  full.diagonal()
      .segment<3>(kAccelerometerBias)
      .setConstant(Square(noise_.accelerometer_walk) * duration());
  return full;
}

ImuPreintegration::Delta ImuPreintegration::CorrectedDelta(const NavState& from) const {
  const Eigen::Matrix<double, 9, 1> correction =
      jacobian_gyro_bias_ * (from.gyro_bias - gyro_bias_) +
      jacobian_accelerometer_bias_ * (from.accelerometer_bias - accelerometer_bias_);
  const Eigen::Vector3d rotation_correction = correction.segment<3>(kRotation);
  return {delta_rotation_ * ExpSo3(rotation_correction),
          delta_position_ + correction.segment<3>(kPosition),
          delta_velocity_ + correction.segment<3>(kVelocity), rotation_correction};
}

NavState ImuPreintegration::Predict(const NavState& from,
                                    const Eigen::Vector3d& gravity_world) const {
  const Delta delta = CorrectedDelta(from);
  const double time = duration();
  NavState to = from;
  to.time = from.time + (end_time_ - start_time_);
  to.T_world_imu.rotation = (from.T_world_imu.rotation * delta.rotation).normalized();
  to.T_world_imu.translation += time * from.v_world_imu + 0.5 * time * time * gravity_world +
                                from.T_world_imu.rotation * delta.position;
  to.v_world_imu += time * gravity_world + from.T_world_imu.rotation * delta.velocity;
  return to;
}

ImuResidual ImuPreintegration::Residual(const NavState& from, const NavState& to,
                                        const Eigen::Vector3d& gravity_world) const {
  const Delta delta = CorrectedDelta(from);
  const double time = duration();
  const Eigen::Quaterniond rotation_imu_world = from.T_world_imu.rotation.conjugate();
  const Eigen::Vector3d position_imu =
      rotation_imu_world * (to.T_world_imu.translation - from.T_world_imu.translation -
                            time * from.v_world_imu - 0.5 * time * time * gravity_world);
  const Eigen::Vector3d velocity_imu =
      rotation_imu_world * (to.v_world_imu - from.v_world_imu - time * gravity_world);

  ImuResidual residual;
  residual.value << LogSo3(delta.rotation.conjugate() * rotation_imu_world *
                           to.T_world_imu.rotation),
      position_imu - delta.position, velocity_imu - delta.velocity, to.gyro_bias - from.gyro_bias,
      to.accelerometer_bias - from.accelerometer_bias;
  FillJacobians(delta, from, to, &residual);
  residual.jacobian_from.block<3, 3>(kPosition, kRotation) = Hat(position_imu);
  residual.jacobian_from.block<3, 3>(kVelocity, kRotation) = Hat(velocity_imu);
  return residual;
}

// Forster et al. 2017, appendix C; positions and velocities here are perturbed in the world frame.
void ImuPreintegration::FillJacobians(const Delta& delta, const NavState& from, const NavState& to,
                                      ImuResidual* residual) const {
  const Eigen::Vector3d rotation_error = residual->value.segment<3>(kRotation);
  const Eigen::Matrix3d log_jacobian = RightJacobianInverseSo3(rotation_error);
  const Eigen::Matrix3d R_imu_world = from.T_world_imu.rotation.conjugate().toRotationMatrix();
  const Eigen::Matrix3d R_to_from =
      (to.T_world_imu.rotation.conjugate() * from.T_world_imu.rotation).toRotationMatrix();

  Matrix15d& by_from = residual->jacobian_from;
  by_from.block<3, 3>(kRotation, kRotation) = -log_jacobian * R_to_from;
  by_from.block<3, 3>(kRotation, kGyroBias) =
      -log_jacobian * ExpSo3(rotation_error).conjugate().toRotationMatrix() *
      RightJacobianSo3(delta.rotation_correction) * jacobian_gyro_bias_.middleRows<3>(kRotation);
  by_from.block<3, 3>(kPosition, kPosition) = -R_imu_world;
  by_from.block<3, 3>(kPosition, kVelocity) = -duration() * R_imu_world;
  by_from.block<3, 3>(kVelocity, kVelocity) = -R_imu_world;
  by_from.block<6, 3>(kPosition, kGyroBias) = -jacobian_gyro_bias_.bottomRows<6>();
  by_from.block<6, 3>(kPosition, kAccelerometerBias) =
      -jacobian_accelerometer_bias_.bottomRows<6>();
  by_from.bottomRightCorner<6, 6>().diagonal().setConstant(-1.0);

  Matrix15d& by_to = residual->jacobian_to;
  by_to.block<3, 3>(kRotation, kRotation) = log_jacobian;
  by_to.block<3, 3>(kPosition, kPosition) = R_imu_world;
  by_to.block<3, 3>(kVelocity, kVelocity) = R_imu_world;
  by_to.bottomRightCorner<6, 6>().diagonal().setOnes();
}

}  // namespace regolith
