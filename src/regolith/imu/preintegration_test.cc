// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/imu/preintegration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "regolith/core/check.h"
#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"
#include "regolith/imu/propagation.h"

namespace regolith {
namespace {

const Eigen::Vector3d kGravityWorld(0.0, 0.0, -3.72);
const Eigen::Vector3d kGyroBias(0.004, -0.003, 0.002);
const Eigen::Vector3d kAccelerometerBias(0.03, -0.05, 0.02);

/// Smooth rotation rate and specific force with all axes in motion.
ImuSample ClosedFormSample(double time) {
  ImuSample sample;
  sample.time = FromSeconds(time);
  sample.angular_velocity = {0.3 * std::sin(2.0 * time), 0.4 * std::cos(1.5 * time),
                             0.5 + 0.2 * std::sin(time)};
  sample.specific_force = {0.6 * std::cos(3.0 * time), 0.8 * std::sin(2.0 * time),
                           3.72 + 0.3 * std::cos(time)};
  return sample;
}

std::vector<ImuSample> Samples(double duration, double dt) {
  std::vector<ImuSample> samples;
  const int count = static_cast<int>(std::lround(duration / dt));
  for (int i = 0; i <= count; ++i) {
    samples.push_back(ClosedFormSample(i * dt));
    samples.back().angular_velocity += kGyroBias;
    samples.back().specific_force += kAccelerometerBias;
  }
  return samples;
}

NavState StartState() {
  NavState state;
  state.T_world_imu.rotation = ExpSo3({0.2, -0.4, 1.3});
  state.T_world_imu.translation = {3.0, -2.0, 0.5};
  state.v_world_imu = {0.4, 0.3, -0.1};
  state.gyro_bias = kGyroBias;
  state.accelerometer_bias = kAccelerometerBias;
  return state;
}

ImuPreintegration Preintegrate(const std::vector<ImuSample>& samples,
                               const Eigen::Vector3d& gyro_bias = kGyroBias,
                               const Eigen::Vector3d& accelerometer_bias = kAccelerometerBias) {
  ImuPreintegration preintegration(ImuNoise(), gyro_bias, accelerometer_bias);
  preintegration.Integrate(samples);
  return preintegration;
}

NavState Perturbed(const NavState& state, const Vector15d& error) {
  NavState result = state;
  result.T_world_imu = Plus(state.T_world_imu, error.head<6>());
  result.v_world_imu += error.segment<3>(6);
  result.gyro_bias += error.segment<3>(9);
  result.accelerometer_bias += error.segment<3>(12);
  return result;
}

TEST(ImuPreintegration, AgreesWithFineIntegrationOfClosedFormMotion) {
  NavState truth = StartState();
  const std::vector<ImuSample> fine = Samples(1.0, 1e-4);
  for (size_t i = 1; i < fine.size(); ++i) {
    truth = Propagate(truth, fine[i - 1], fine[i], kGravityWorld);
  }
  const NavState predicted = Preintegrate(Samples(1.0, 0.005)).Predict(StartState(), kGravityWorld);
  EXPECT_EQ(predicted.time, truth.time);
  EXPECT_LT((predicted.T_world_imu.translation - truth.T_world_imu.translation).norm(), 2e-5);
  EXPECT_LT((predicted.v_world_imu - truth.v_world_imu).norm(), 4e-5);
  EXPECT_LT(AngleBetween(predicted.T_world_imu.rotation, truth.T_world_imu.rotation), 1e-5);
}

TEST(ImuPreintegration, PredictsExactlyWhatPropagationGives) {
  const std::vector<ImuSample> samples = Samples(0.5, 0.005);
  NavState state = StartState();
  for (size_t i = 1; i < samples.size(); ++i) {
    state = Propagate(state, samples[i - 1], samples[i], kGravityWorld);
  }
  const NavState predicted = Preintegrate(samples).Predict(StartState(), kGravityWorld);
  EXPECT_LT((predicted.T_world_imu.translation - state.T_world_imu.translation).norm(), 1e-12);
  EXPECT_LT((predicted.v_world_imu - state.v_world_imu).norm(), 1e-12);
  EXPECT_LT(AngleBetween(predicted.T_world_imu.rotation, state.T_world_imu.rotation), 1e-12);
}

TEST(ImuPreintegration, BiasJacobiansAgreeWithDifferences) {
  const std::vector<ImuSample> samples = Samples(0.4, 0.005);
  const ImuPreintegration centre = Preintegrate(samples);
  constexpr double kStep = 1e-5;
  for (int axis = 0; axis < 6; ++axis) {
    Eigen::Matrix<double, 9, 1> ends[2];
    for (int end = 0; end < 2; ++end) {
      Eigen::Matrix<double, 6, 1> change = Eigen::Matrix<double, 6, 1>::Zero();
      change[axis] = end == 0 ? -kStep : kStep;
      const ImuPreintegration moved = Preintegrate(samples, kGyroBias + change.head<3>(),
                                                   kAccelerometerBias + change.tail<3>());
      ends[end] << LogSo3(centre.delta_rotation().conjugate() * moved.delta_rotation()),
          moved.delta_position(), moved.delta_velocity();
    }
    const Eigen::Matrix<double, 9, 1> numeric = (ends[1] - ends[0]) / (2.0 * kStep);
    const Eigen::Matrix<double, 9, 1> analytic =
        axis < 3 ? centre.jacobian_gyro_bias().col(axis)
                 : centre.jacobian_accelerometer_bias().col(axis - 3);
    EXPECT_LT((numeric - analytic).norm(), 1e-7) << "axis " << axis;
  }
}

TEST(ImuPreintegration, CovarianceAgreesWithMonteCarlo) {
  constexpr double kInterval = 0.005;
  constexpr int kTrials = 4000;
  const ImuNoise noise;
  const std::vector<ImuSample> clean = Samples(0.5, kInterval);
  const ImuPreintegration reference = Preintegrate(clean);
  const double gyro_sigma = noise.gyro_density / std::sqrt(kInterval);
  const double accelerometer_sigma = noise.accelerometer_density / std::sqrt(kInterval);
  Random random(31);
  Matrix9d sampled = Matrix9d::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<ImuSample> noisy = clean;
    for (ImuSample& sample : noisy) {
      for (int axis = 0; axis < 3; ++axis) {
        sample.angular_velocity[axis] += random.Gaussian(0.0, gyro_sigma);
        sample.specific_force[axis] += random.Gaussian(0.0, accelerometer_sigma);
      }
    }
    const ImuPreintegration moved = Preintegrate(noisy);
    Eigen::Matrix<double, 9, 1> error;
    error << LogSo3(reference.delta_rotation().conjugate() * moved.delta_rotation()),
        moved.delta_position() - reference.delta_position(),
        moved.delta_velocity() - reference.delta_velocity();
    sampled += error * error.transpose() / kTrials;
  }
  // A variance from 4000 trials scatters by 2.2 %; correlations by 1.6 points.
  const Matrix9d& predicted = reference.covariance();
  for (int row = 0; row < 9; ++row) {
    EXPECT_NEAR(sampled(row, row) / predicted(row, row), 1.0, 0.09) << "row " << row;
    for (int column = 0; column < row; ++column) {
      const double scale = std::sqrt(predicted(row, row) * predicted(column, column));
      EXPECT_NEAR(sampled(row, column) / scale, predicted(row, column) / scale, 0.07);
    }
  }
}

TEST(ImuPreintegration, FullCovarianceWalksTheBiases) {
  const ImuNoise noise;
  const Matrix15d full = Preintegrate(Samples(0.5, 0.005)).FullCovariance();
  EXPECT_NEAR(full(10, 10), 0.5 * noise.gyro_walk * noise.gyro_walk, 1e-18);
  EXPECT_NEAR(full(13, 13), 0.5 * noise.accelerometer_walk * noise.accelerometer_walk, 1e-12);
}

TEST(ImuPreintegration, ResidualVanishesAtThePrediction) {
  const ImuPreintegration preintegration = Preintegrate(Samples(0.4, 0.005));
  Vector15d change = Vector15d::Zero();
  change.tail<6>() << 1e-3, -2e-3, 5e-4, 0.01, 0.02, -0.03;
  const NavState from = Perturbed(StartState(), change);
  const NavState to = preintegration.Predict(from, kGravityWorld);
  EXPECT_LT(preintegration.Residual(from, to, kGravityWorld).value.norm(), 1e-12);
}

TEST(ImuPreintegration, ResidualJacobiansAgreeWithDifferences) {
  const ImuPreintegration preintegration = Preintegrate(Samples(0.4, 0.005));
  Vector15d change;
  change << 0.1, -0.2, 0.15, 0.3, 0.2, -0.1, 0.05, -0.1, 0.2, 1e-3, 2e-3, -1e-3, 0.02, -0.01, 0.03;
  const NavState from = Perturbed(StartState(), -0.5 * change);
  const NavState to = Perturbed(preintegration.Predict(StartState(), kGravityWorld), change);
  const ImuResidual residual = preintegration.Residual(from, to, kGravityWorld);
  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 15; ++axis) {
    const Vector15d step = kStep * Vector15d::Unit(axis);
    const Vector15d by_from =
        (preintegration.Residual(Perturbed(from, step), to, kGravityWorld).value -
         preintegration.Residual(Perturbed(from, -step), to, kGravityWorld).value) /
        (2.0 * kStep);
    const Vector15d by_to =
        (preintegration.Residual(from, Perturbed(to, step), kGravityWorld).value -
         preintegration.Residual(from, Perturbed(to, -step), kGravityWorld).value) /
        (2.0 * kStep);
    EXPECT_LT((by_from - residual.jacobian_from.col(axis)).norm(), 1e-7) << "from, axis " << axis;
    EXPECT_LT((by_to - residual.jacobian_to.col(axis)).norm(), 1e-7) << "to, axis " << axis;
  }
}

TEST(ImuPreintegration, RefusesAGapBetweenSteps) {
  ImuPreintegration preintegration(ImuNoise(), kGyroBias, kAccelerometerBias);
  preintegration.Integrate(ClosedFormSample(0.0), ClosedFormSample(0.1));
  EXPECT_THROW(preintegration.Integrate(ClosedFormSample(0.2), ClosedFormSample(0.3)), CheckError);
  EXPECT_THROW(preintegration.Integrate(ClosedFormSample(0.1), ClosedFormSample(0.1)), CheckError);
}

}  // namespace
}  // namespace regolith
