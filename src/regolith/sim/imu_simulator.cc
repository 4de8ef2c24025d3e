// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/imu_simulator.h"

#include <cmath>

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;

// Small angles: an axis that leans by e towards another measures e of what happens along that.
Eigen::Matrix3d DrawAxes(double scale_sigma, double misalignment_deg, Random* random) {
  Eigen::Matrix3d axes;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      axes(row, column) = row == column ? random->Gaussian(1.0, scale_sigma)
                                        : random->Gaussian(0.0, misalignment_deg * kDegree);
    }
  }
  return axes;
}

}  // namespace

ImuSample ExactImu(const MotionState& motion, double gravity) {
  ImuSample sample;
  sample.angular_velocity = motion.angular_velocity_imu;
  sample.specific_force = motion.T_world_imu.rotation.conjugate() *
                          (motion.a_world_imu + Eigen::Vector3d(0.0, 0.0, gravity));
  return sample;
}

ImuSimulator::ImuSimulator(const ImuOptions& options, double gravity, uint64_t seed)
    : options_(options), gravity_(gravity), random_(seed, "imu") {
  Random axes(seed, "imu axes");
  gyro_axes_ = DrawAxes(options.gyro_scale_sigma, options.gyro_misalignment_deg, &axes);
  accelerometer_axes_ =
      DrawAxes(options.accelerometer_scale_sigma, options.accelerometer_misalignment_deg, &axes);
  gyro_bias_ = Gaussian(options.noise.gyro_bias_sigma);
  accelerometer_bias_ = Gaussian(options.noise.accelerometer_bias_sigma);
}

Eigen::Vector3d ImuSimulator::Gaussian(double sigma) {
  const double x = random_.Gaussian(0.0, sigma);
  const double y = random_.Gaussian(0.0, sigma);
  const double z = random_.Gaussian(0.0, sigma);
  return {x, y, z};
}

ImuSample ImuSimulator::Measure(const MotionState& motion) {
  const double root_rate = std::sqrt(options_.rate);
  ImuSample sample = ExactImu(motion, gravity_);
  sample.angular_velocity = gyro_axes_ * sample.angular_velocity;
  sample.specific_force = accelerometer_axes_ * sample.specific_force;
  sample.angular_velocity += gyro_bias_ + Gaussian(options_.noise.gyro_density * root_rate);
  sample.specific_force +=
      accelerometer_bias_ + Gaussian(options_.noise.accelerometer_density * root_rate);
  gyro_bias_ += Gaussian(options_.noise.gyro_walk / root_rate);
  accelerometer_bias_ += Gaussian(options_.noise.accelerometer_walk / root_rate);
  return sample;
}

}  // namespace regolith
