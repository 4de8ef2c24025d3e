// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/imu/rest_detection.h"

#include <cmath>

#include "regolith/core/check.h"

namespace regolith {

ImuStatistics ComputeImuStatistics(Span<const ImuSample> samples) {
  REGOLITH_CHECK(samples.size() >= 2, samples.size(), " samples");
  ImuStatistics statistics;
  statistics.count = static_cast<int>(samples.size());
  statistics.duration = SecondsBetween(samples.front().time, samples.back().time);
  const double count = static_cast<double>(samples.size());
  for (const ImuSample& sample : samples) {
    statistics.mean_rate += sample.angular_velocity / count;
    statistics.mean_specific_force += sample.specific_force / count;
  }
  Eigen::Array3d squares_rate = Eigen::Array3d::Zero();
  Eigen::Array3d squares_force = Eigen::Array3d::Zero();
  for (const ImuSample& sample : samples) {
    squares_rate += (sample.angular_velocity - statistics.mean_rate).array().square();
    squares_force += (sample.specific_force - statistics.mean_specific_force).array().square();
  }
  statistics.sigma_rate = (squares_rate / (count - 1.0)).sqrt();
  statistics.sigma_specific_force = (squares_force / (count - 1.0)).sqrt();
  return statistics;
}

namespace {

/// The first sign of motion; empty where there is none. Comparisons fail on NaN.
std::string SignOfMotion(const ImuStatistics& statistics, double gravity,
                         const RestDetectionOptions& options) {
  const auto exceeds = [](const char* what, double value, double limit, const char* unit) {
    return Concatenate(what, " is ", value, " ", unit, ", above ", limit);
  };
  const double gyro_sigma = statistics.sigma_rate.maxCoeff();
  if (!(gyro_sigma <= options.max_gyro_sigma)) {
    return exceeds("spread of the rotation rate", gyro_sigma, options.max_gyro_sigma, "rad/s");
  }
  const double force_sigma = statistics.sigma_specific_force.maxCoeff();
  const double max_force_sigma = options.max_force_sigma_share * gravity;
  if (!(force_sigma <= max_force_sigma)) {
    return exceeds("spread of the specific force", force_sigma, max_force_sigma, "m/s²");
  }
  const double rate = statistics.mean_rate.norm();
  if (!(rate <= options.max_mean_rate)) {
    return exceeds("mean rotation rate", rate, options.max_mean_rate, "rad/s");
  }
  const double force_error = std::abs(statistics.mean_specific_force.norm() - gravity);
  const double max_force_error = options.max_force_error_share * gravity;
  if (!(force_error <= max_force_error)) {
    return exceeds("difference of specific force and gravity", force_error, max_force_error,
                   "m/s²");
  }
  return "";
}

}  // namespace

RestReport DetectRest(Span<const ImuSample> samples, double gravity,
                      const RestDetectionOptions& options) {
  options.Check();
  REGOLITH_CHECK(gravity > 0.0, "gravity ", gravity);
  RestReport report;
  if (samples.size() >= 2) report.statistics = ComputeImuStatistics(samples);
  if (report.statistics.duration < options.min_duration) {
    report.reason = Concatenate("the window covers ", report.statistics.duration, " s, less than ",
                                options.min_duration);
    return report;
  }
  report.reason = SignOfMotion(report.statistics, gravity, options);
  report.at_rest = report.reason.empty();
  return report;
}

Eigen::Quaterniond RotationFromUp(const Eigen::Vector3d& up_imu) {
  REGOLITH_CHECK(up_imu.norm() > 0.0, "direction ", up_imu.transpose());
  // Within a twentieth of a degree of the vertical an axis has no heading worth the name.
  constexpr double kLeastHorizontal = 1e-3;
  const Eigen::Vector3d up = up_imu.normalized();
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX() - up.x() * up;
  Eigen::Vector3d x_world_in_imu;
  if (forward.norm() > kLeastHorizontal) {
    x_world_in_imu = forward.normalized();
  } else {
    const Eigen::Vector3d left = (Eigen::Vector3d::UnitY() - up.y() * up).normalized();
    x_world_in_imu = left.cross(up);
  }
  Eigen::Matrix3d R_world_imu;
  R_world_imu << x_world_in_imu.transpose(), up.cross(x_world_in_imu).transpose(), up.transpose();
  return Eigen::Quaterniond(R_world_imu).normalized();
}

RestState InitializeAtRest(const ImuStatistics& statistics) {
  RestState state;
  state.rotation_world_imu = RotationFromUp(statistics.mean_specific_force);
  state.gyro_bias = statistics.mean_rate;
  state.specific_force_norm = statistics.mean_specific_force.norm();
  const double root = std::sqrt(static_cast<double>(statistics.count));
  state.gyro_bias_sigma = statistics.sigma_rate.maxCoeff() / root;
  state.tilt_sigma = statistics.sigma_specific_force.maxCoeff() / root / state.specific_force_norm;
  return state;
}

}  // namespace regolith
