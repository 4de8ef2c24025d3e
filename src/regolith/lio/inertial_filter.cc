// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/inertial_filter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "regolith/geometry/so3.h"
#include "regolith/imu/propagation.h"

namespace regolith {
namespace {

constexpr int kRotation = 0;
constexpr int kPosition = 3;
constexpr int kVelocity = 6;
constexpr int kGyroBias = 9;
constexpr int kAccelerometerBias = 12;
constexpr int kGravity = 15;
constexpr int kWheelSlip = 18;
// Keeps the covariance invertible along what is fixed by definition: the first pose, gravity's
// magnitude.
constexpr double kFixedSigma = 1e-4;
// A body that moves unseen, 1 σ: rovers neither turn nor accelerate harder.
constexpr double kBlindRate = 0.5;          // rad/s
constexpr double kBlindAcceleration = 1.0;  // m/s²
// Poses farther apart say nothing of the rate.
constexpr double kRateMemory = 0.5;  // s
// Chi-squared of three at 95 %: a camera that is well says less than 1, so nothing of it is lost.
constexpr double kVelocityGate = 7.81;

template <int kAt>
auto Diagonal(InertialFilter::Covariance& covariance) {
  return covariance.diagonal().segment<3>(kAt);
}

}  // namespace

InertialFilter::InertialFilter(TimeNs time, const RestReport& first_samples, double gravity,
                               const ImuNoise& noise, const InertialFilterOptions& options)
    : gravity_world_(0.0, 0.0, -gravity), gravity_(gravity), noise_(noise), options_(options) {
  const RestState rest = InitializeAtRest(first_samples.statistics);
  const bool at_rest = first_samples.at_rest;
  state_.time = time;
  state_.T_world_imu.rotation = rest.rotation_world_imu;
  if (at_rest) state_.gyro_bias = rest.gyro_bias;

  Diagonal<kRotation>(covariance_).setConstant(kFixedSigma * kFixedSigma);
  Diagonal<kPosition>(covariance_).setConstant(kFixedSigma * kFixedSigma);
  const double velocity_sigma =
      at_rest ? options.rest_velocity_sigma : options.moving_velocity_sigma;
  Diagonal<kVelocity>(covariance_).setConstant(velocity_sigma * velocity_sigma);
  const double gyro_sigma = at_rest ? rest.gyro_bias_sigma + 1e-5 : noise.gyro_bias_sigma;
  Diagonal<kGyroBias>(covariance_).setConstant(gyro_sigma * gyro_sigma);
  const double bias_sigma = noise.accelerometer_bias_sigma;
  Diagonal<kAccelerometerBias>(covariance_).setConstant(bias_sigma * bias_sigma);
  // What tilts the first attitude: the bias, and the rover's own acceleration where it moves.
  const double tilt_sigma =
      rest.tilt_sigma + bias_sigma / gravity + (at_rest ? 0.0 : options.moving_tilt_sigma);
  const double horizontal = gravity * tilt_sigma;
  covariance_.diagonal().segment<2>(kGravity).setConstant(horizontal * horizontal);
  covariance_(kGravity + 2, kGravity + 2) = kFixedSigma * kFixedSigma;
  covariance_(kWheelSlip, kWheelSlip) = std::pow(options.wheels.slip_sigma, 2);
}

void InertialFilter::MoveInto(const SE3& T_world_imu, const Eigen::Vector3d& v_world_imu,
                              double velocity_sigma) {
  const Eigen::Matrix3d turn =
      (T_world_imu.rotation * state_.T_world_imu.rotation.conjugate()).toRotationMatrix();
  state_.T_world_imu = T_world_imu;
  state_.v_world_imu = v_world_imu;
  Diagonal<kVelocity>(covariance_).setConstant(velocity_sigma * velocity_sigma);
  gravity_world_ = turn * gravity_world_;
  const Eigen::Matrix3d gravity = covariance_.block<3, 3>(kGravity, kGravity);
  covariance_.block<3, 3>(kGravity, kGravity) = turn * gravity * turn.transpose();
}

Matrix6d InertialFilter::BeginWorld() {
  Matrix6d pose_covariance = PoseCovariance();
  // The attitude's error becomes the new world's, which turns what is known in the world's axes.
  const Eigen::Matrix3d rotation = state_.T_world_imu.rotation.toRotationMatrix();
  Covariance transition = Covariance::Identity();
  transition.topLeftCorner<6, 6>().setZero();
  transition.block<3, 3>(kVelocity, kRotation) = Hat(state_.v_world_imu) * rotation;
  transition.block<3, 3>(kGravity, kRotation) = Hat(gravity_world_) * rotation;
  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  Diagonal<kRotation>(covariance_).setConstant(kFixedSigma * kFixedSigma);
  Diagonal<kPosition>(covariance_).setConstant(kFixedSigma * kFixedSigma);
  return pose_covariance;
}

void InertialFilter::Propagate(const ImuSample& from, const ImuSample& to) {
  const double dt = SecondsBetween(from.time, to.time);
  if (dt <= 0.0) return;
  const Eigen::Vector3d rate =
      0.5 * (from.angular_velocity + to.angular_velocity) - state_.gyro_bias;
  const Eigen::Vector3d force =
      0.5 * (from.specific_force + to.specific_force) - state_.accelerometer_bias;
  const Eigen::Matrix3d rotation = state_.T_world_imu.rotation.toRotationMatrix();
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();

  // Solà 2017, eq. 269–270, with the position's second-order terms left to the velocity.
  Covariance transition = Covariance::Identity();
  transition.block<3, 3>(kRotation, kRotation) = ExpSo3(-rate * dt).toRotationMatrix();
  transition.block<3, 3>(kRotation, kGyroBias) = -RightJacobianSo3(rate * dt) * dt;
  transition.block<3, 3>(kPosition, kVelocity) = identity * dt;
  transition.block<3, 3>(kVelocity, kRotation) = -rotation * Hat(force) * dt;
  transition.block<3, 3>(kVelocity, kAccelerometerBias) = -rotation * dt;
  transition.block<3, 3>(kVelocity, kGravity) = identity * dt;
  covariance_ = (transition * covariance_ * transition.transpose()).eval();

  const double inflation = options_.noise_inflation * options_.noise_inflation;
  Diagonal<kRotation>(covariance_).array() += inflation * std::pow(noise_.gyro_density, 2) * dt;
  Diagonal<kVelocity>(covariance_).array() +=
      inflation * std::pow(noise_.accelerometer_density, 2) * dt;
  Diagonal<kGyroBias>(covariance_).array() += std::pow(noise_.gyro_walk, 2) * dt;
  Diagonal<kAccelerometerBias>(covariance_).array() += std::pow(noise_.accelerometer_walk, 2) * dt;

  // Slip returns to what it was at the start, so that it does not wander without end.
  const double most = std::pow(options_.wheels.slip_sigma, 2);
  const double walk = std::pow(options_.wheels.slip_walk, 2) * dt;
  covariance_(kWheelSlip, kWheelSlip) = std::min(most, covariance_(kWheelSlip, kWheelSlip) + walk);

  state_ = regolith::Propagate(state_, from, to, gravity_world_);
}

Eigen::Vector3d InertialFilter::BlindRate() const {
  const bool is_old = SecondsBetween(last_pose_time_, state_.time) > kRateMemory;
  return is_old ? Eigen::Vector3d::Zero() : rate_;
}

void InertialFilter::PropagateBlindly(TimeNs time) {
  const double dt = SecondsBetween(state_.time, time);
  if (dt <= 0.0) return;
  const Eigen::Quaterniond turn = ExpSo3(BlindRate() * dt);
  const Eigen::Quaterniond before = state_.T_world_imu.rotation;
  state_.T_world_imu.translation += state_.v_world_imu * dt;
  state_.T_world_imu.rotation = (before * turn).normalized();
  state_.v_world_imu = state_.T_world_imu.rotation * (before.conjugate() * state_.v_world_imu);
  state_.time = time;
  Covariance transition = Covariance::Identity();
  transition.block<3, 3>(kRotation, kRotation) = turn.conjugate().toRotationMatrix();
  transition.block<3, 3>(kPosition, kVelocity) = Eigen::Matrix3d::Identity() * dt;
  covariance_ = (transition * covariance_ * transition.transpose()).eval();
  covariance_.block<kGyroBias, kSize - kGyroBias>(0, kGyroBias).setZero();
  covariance_.block<kSize - kGyroBias, kGyroBias>(kGyroBias, 0).setZero();
  Diagonal<kRotation>(covariance_).array() += std::pow(kBlindRate * dt, 2);
  Diagonal<kVelocity>(covariance_).array() += std::pow(kBlindAcceleration * dt, 2);
  Diagonal<kPosition>(covariance_).array() += std::pow(0.5 * kBlindAcceleration * dt * dt, 2);
}

void InertialFilter::AbsorbPose(const SE3& T_world_imu, const Matrix6d& covariance) {
  const Matrix6d prior_inverse = PoseCovariance().ldlt().solve(Matrix6d::Identity());
  // x | pose is Gaussian with gain P_x,pose P_pose⁻¹: the pose's new mean and covariance pass
  // through it.
  const Eigen::Matrix<double, kSize, 6> gain = covariance_.leftCols<6>() * prior_inverse;
  const Matrix6d lost = PoseCovariance() - covariance;
  Covariance updated = covariance_ - gain * lost * gain.transpose();
  covariance_ = 0.5 * (updated + updated.transpose());
  Correct(gain * Minus(T_world_imu, state_.T_world_imu));
  const double seconds = SecondsBetween(last_pose_time_, state_.time);
  const Eigen::Quaterniond& rotation = state_.T_world_imu.rotation;
  rate_ = seconds > 0.0 && seconds < kRateMemory
              ? Eigen::Vector3d(LogSo3(last_rotation_.conjugate() * rotation) / seconds)
              : Eigen::Vector3d::Zero();
  last_rotation_ = rotation;
  last_pose_time_ = state_.time;
}

void InertialFilter::AbsorbWheels(const WheelOdometry& wheels, const SE3& T_imu_base,
                                  const Eigen::Vector3d& rate, bool is_placed) {
  const Eigen::Matrix3d R_base_imu = T_imu_base.rotation.conjugate().toRotationMatrix();
  const Eigen::Matrix3d R_imu_world = state_.T_world_imu.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d velocity_imu = R_imu_world * state_.v_world_imu;
  const Eigen::Vector3d true_rate = rate - state_.gyro_bias;
  const Eigen::Vector3d velocity_base =
      R_base_imu * (velocity_imu + true_rate.cross(T_imu_base.translation));
  // The wheels roll (1 + slip) times the way.
  Eigen::Matrix<double, 3, kSize> jacobian = Eigen::Matrix<double, 3, kSize>::Zero();
  jacobian.block<3, 3>(0, kRotation) = R_base_imu * Hat(velocity_imu);
  jacobian.block<3, 3>(0, kVelocity) = R_base_imu * R_imu_world;
  jacobian.block<3, 3>(0, kGyroBias) = R_base_imu * Hat(T_imu_base.translation);
  jacobian.row(0) *= 1.0 + wheel_slip_;
  jacobian(0, kWheelSlip) = velocity_base.x();
  Eigen::Vector3d predicted = velocity_base;
  predicted.x() *= 1.0 + wheel_slip_;

  const WheelVelocityOptions& trust = options_.wheels;
  const double speed = std::abs(wheels.linear_velocity_base.x());
  const double skid = trust.turn_share * std::abs(wheels.angular_velocity_base.z());
  const double floor = std::pow(trust.velocity_sigma, 2) + skid * skid;
  const Eigen::Vector3d variances(floor, floor + std::pow(trust.lateral_share * speed, 2),
                                  floor + std::pow(trust.vertical_share * speed, 2));
  Absorb<3>(jacobian, wheels.linear_velocity_base - predicted, variances,
            is_placed ? trust.placed_inflation * trust.placed_inflation : 1.0);
}

InertialFilter::VelocityInnovation InertialFilter::Compare(
    const Eigen::Vector3d& velocity_imu) const {
  const Eigen::Matrix3d R_imu_world = state_.T_world_imu.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d predicted = R_imu_world * state_.v_world_imu;
  VelocityInnovation innovation;
  innovation.jacobian.block<3, 3>(0, kRotation) = Hat(predicted);
  innovation.jacobian.block<3, 3>(0, kVelocity) = R_imu_world;
  innovation.value = velocity_imu - predicted;
  return innovation;
}

void InertialFilter::AbsorbVelocity(const Eigen::Vector3d& velocity_imu, double sigma) {
  const VelocityInnovation innovation = Compare(velocity_imu);
  Absorb<3>(innovation.jacobian, innovation.value, Eigen::Vector3d::Constant(sigma * sigma));
}

bool InertialFilter::CanBe(const Eigen::Vector3d& velocity_imu, double sigma) const {
  const VelocityInnovation innovation = Compare(velocity_imu);
  Eigen::Matrix3d covariance = innovation.jacobian * covariance_ * innovation.jacobian.transpose();
  covariance.diagonal().array() += sigma * sigma;
  return innovation.value.dot(covariance.ldlt().solve(innovation.value)) <= kVelocityGate;
}

void InertialFilter::AbsorbRest(const ImuStatistics& samples) {
  // z = [v; mean rate - gyro bias] = 0.
  Eigen::Matrix<double, 6, kSize> jacobian = Eigen::Matrix<double, 6, kSize>::Zero();
  jacobian.block<3, 3>(0, kVelocity).setIdentity();
  jacobian.block<3, 3>(3, kGyroBias).setIdentity();
  Vector6d innovation;
  innovation << -state_.v_world_imu, samples.mean_rate - state_.gyro_bias;
  const double rate_sigma =
      samples.sigma_rate.maxCoeff() / std::sqrt(std::max(1.0, static_cast<double>(samples.count))) +
      1e-5;
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(std::pow(options_.rest_velocity_sigma, 2)),
      Eigen::Vector3d::Constant(rate_sigma * rate_sigma);
  Absorb<6>(jacobian, innovation, variances);
}

template <int kRows>
void InertialFilter::Absorb(const Eigen::Matrix<double, kRows, kSize>& jacobian,
                            const Eigen::Matrix<double, kRows, 1>& innovation,
                            const Eigen::Matrix<double, kRows, 1>& variances, double caution) {
  using Square = Eigen::Matrix<double, kRows, kRows>;
  using Gain = Eigen::Matrix<double, kSize, kRows>;
  const Square predicted_covariance = jacobian * covariance_ * jacobian.transpose();
  const auto gain_for = [&](double factor) -> Gain {
    Square innovation_covariance = predicted_covariance;
    innovation_covariance.diagonal() += factor * variances;
    return innovation_covariance.ldlt().solve(jacobian * covariance_).transpose();
  };
  Gain gain = gain_for(caution);
  if (caution != 1.0) gain.row(kWheelSlip) = gain_for(1.0).row(kWheelSlip);
  // Joseph's form keeps the covariance positive.
  const Covariance remaining = Covariance::Identity() - gain * jacobian;
  const Covariance updated = remaining * covariance_ * remaining.transpose() +
                             gain * variances.asDiagonal() * gain.transpose();
  covariance_ = 0.5 * (updated + updated.transpose());
  Correct(gain * innovation);
}

void InertialFilter::Correct(const Eigen::Matrix<double, kSize, 1>& error) {
  state_.T_world_imu = Plus(state_.T_world_imu, error.head<6>());
  state_.v_world_imu += error.segment<3>(kVelocity);
  state_.gyro_bias += error.segment<3>(kGyroBias);
  state_.accelerometer_bias += error.segment<3>(kAccelerometerBias);
  wheel_slip_ += error[kWheelSlip];
  gravity_world_ = gravity_ * (gravity_world_ + error.segment<3>(kGravity)).normalized();
}

}  // namespace regolith
