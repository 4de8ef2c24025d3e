// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/inertial_filter.h"

#include <gtest/gtest.h>

#include <vector>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr double kGravity = 1.62;
constexpr double kStep = 0.005;

std::vector<ImuSample> RestingSamples(int count, const Eigen::Quaterniond& rotation_world_imu,
                                      const Eigen::Vector3d& gyro_bias,
                                      const Eigen::Vector3d& accelerometer_bias) {
  Random random(3);
  const auto noise = [&](double sigma) {
    return Eigen::Vector3d(random.Gaussian(0, sigma), random.Gaussian(0, sigma),
                           random.Gaussian(0, sigma));
  };
  std::vector<ImuSample> samples;
  for (int i = 0; i < count; ++i) {
    ImuSample sample;
    sample.time = AddSeconds(0, kStep * i);
    sample.angular_velocity = gyro_bias + noise(0.0024);
    sample.specific_force = rotation_world_imu.conjugate() * Eigen::Vector3d(0, 0, kGravity) +
                            accelerometer_bias + noise(0.028);
    samples.push_back(sample);
  }
  return samples;
}

InertialFilter RestingFilter(const std::vector<ImuSample>& samples) {
  const Span<const ImuSample> first_second(samples.data(), 201);
  InertialFilter filter(0, DetectRest(first_second, kGravity, {}), kGravity, ImuNoise(), {});
  for (size_t i = 1; i < samples.size(); ++i) {
    filter.Propagate(samples[i - 1], samples[i]);
    if (i >= 100 && i % 20 == 0) {
      filter.AbsorbRest(ComputeImuStatistics(Span<const ImuSample>(samples).Subspan(i - 100, 101)));
    }
  }
  return filter;
}

TEST(InertialFilter, AtRestItStaysAndLearnsTheGyroBias) {
  const Eigen::Vector3d bias(0.004, -0.006, 0.003);
  const auto samples =
      RestingSamples(2000, ExpSo3({0.1, -0.05, 0.0}), bias, Eigen::Vector3d::Zero());
  const InertialFilter filter = RestingFilter(samples);
  EXPECT_LT((filter.state().gyro_bias - bias).norm(), 2e-4);
  EXPECT_LT(filter.state().T_world_imu.translation.norm(), 0.02);
  EXPECT_LT(filter.state().v_world_imu.norm(), 0.01);
}

TEST(InertialFilter, AtRestTheVerticalBiasShowsAndTheHorizontalStaysTiedToGravity) {
  const auto samples = RestingSamples(2000, Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero(),
                                      {0.05, 0.0, -0.04});
  const InertialFilter filter = RestingFilter(samples);
  EXPECT_NEAR(filter.state().accelerometer_bias.z(), -0.04, 0.01);
  EXPECT_NEAR(filter.gravity_world().norm(), kGravity, 1e-9);
  // Bias and tilt cannot be told apart at rest: both stay uncertain, their sum does not.
  const auto& covariance = filter.covariance();
  EXPECT_GT(std::sqrt(covariance(12, 12)), 0.02);
  const double correlation =
      covariance(12, 15) / std::sqrt(covariance(12, 12) * covariance(15, 15));
  EXPECT_GT(std::abs(correlation), 0.9);
}

TEST(InertialFilter, ExactPosesTeachVelocityAndBias) {
  const Eigen::Vector3d bias(0.03, -0.02, 0.04);
  const auto samples =
      RestingSamples(4000, Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero(), bias);
  // The same samples with an acceleration of 0.1 m/s² while yawing, so that bias and gravity part.
  const Eigen::Vector3d rate(0.0, 0.0, 0.3);
  RestReport start;
  start.at_rest = true;
  start.statistics = ComputeImuStatistics(Span<const ImuSample>(samples).Subspan(0, 200));
  InertialFilter filter(0, start, kGravity, ImuNoise(), {});
  const Eigen::Quaterniond first = filter.state().T_world_imu.rotation;
  const auto rotation_at = [&](double t) { return Eigen::Quaterniond(ExpSo3(rate * t)); };
  Matrix6d covariance = Matrix6d::Identity() * 1e-6;
  const auto moving = [&](size_t i) {
    ImuSample sample = samples[i];
    const Eigen::Quaterniond rotation = rotation_at(kStep * static_cast<double>(i));
    sample.angular_velocity += rate;
    sample.specific_force += rotation.conjugate() * Eigen::Vector3d(0.1, 0.0, 0.0);
    return sample;
  };
  // Truth is level; the filter's world is tilted by what the bias did to its first attitude.
  for (size_t i = 1; i < samples.size(); ++i) {
    filter.Propagate(moving(i - 1), moving(i));
    if (i % 20 != 0) continue;
    const double t = kStep * static_cast<double>(i);
    const SE3 truth(rotation_at(t), {0.05 * t * t, 0.0, 0.0});
    filter.AbsorbPose({first * truth.rotation, first * truth.translation}, covariance);
  }
  EXPECT_LT((filter.state().accelerometer_bias - bias).norm(), 0.015);
  EXPECT_LT((filter.state().v_world_imu - first * Eigen::Vector3d(2.0, 0.0, 0.0)).norm(), 0.05);
}

TEST(InertialFilter, AbsorbingThePriorChangesNothing) {
  const auto samples = RestingSamples(400, Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero(),
                                      Eigen::Vector3d::Zero());
  InertialFilter filter = RestingFilter(samples);
  const auto before = filter.covariance();
  const NavState state = filter.state();
  filter.AbsorbPose(state.T_world_imu, filter.PoseCovariance());
  EXPECT_LT((filter.covariance() - before).norm(), 1e-12);
  EXPECT_LT(Minus(filter.state().T_world_imu, state.T_world_imu).norm(), 1e-12);
}

TEST(InertialFilter, WheelsSayLessWhereThePoseIsKnown) {
  const auto samples = RestingSamples(400, Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero(),
                                      Eigen::Vector3d::Zero());
  WheelOdometry wheels;
  wheels.linear_velocity_base = {0.5, 0.0, 0.0};
  InertialFilter alone = RestingFilter(samples);
  InertialFilter placed = alone;
  alone.AbsorbWheels(wheels, SE3(), Eigen::Vector3d::Zero(), false);
  placed.AbsorbWheels(wheels, SE3(), Eigen::Vector3d::Zero(), true);
  EXPECT_GT(placed.state().v_world_imu.x(), 0.0);
  EXPECT_GT(alone.state().v_world_imu.x(), 2.0 * placed.state().v_world_imu.x());
  EXPECT_LT(alone.covariance()(6, 6), placed.covariance()(6, 6));
}

TEST(InertialFilter, WhatVelocityCanBeDependsOnTheDoubt) {
  const auto samples = RestingSamples(400, ExpSo3({0.1, -0.05, 0.0}), Eigen::Vector3d::Zero(),
                                      Eigen::Vector3d::Zero());
  InertialFilter filter = RestingFilter(samples);
  EXPECT_TRUE(filter.CanBe({0.05, 0.0, 0.0}, 0.05));
  EXPECT_FALSE(filter.CanBe({0.5, 0.0, 0.0}, 0.05));
  EXPECT_TRUE(filter.CanBe({0.5, 0.0, 0.0}, 0.3));
  filter.PropagateBlindly(AddSeconds(filter.state().time, 1.0));
  EXPECT_TRUE(filter.CanBe({0.5, 0.0, 0.0}, 0.05));
}

TEST(InertialFilter, GravityKeepsItsPlaceWhereTheWorldIsAnother) {
  const auto samples = RestingSamples(400, ExpSo3({0.1, -0.05, 0.0}), Eigen::Vector3d::Zero(),
                                      Eigen::Vector3d::Zero());
  InertialFilter filter = RestingFilter(samples);
  const Eigen::Vector3d felt =
      filter.state().T_world_imu.rotation.conjugate() * filter.gravity_world();
  const SE3 pose{ExpSo3({0.3, 0.2, 1.0}), {1.0, 2.0, 3.0}};
  filter.MoveInto(pose, {0.4, 0.0, 0.0}, 0.3);
  EXPECT_LT((pose.rotation.conjugate() * filter.gravity_world() - felt).norm(), 1e-9);
  EXPECT_NEAR(filter.covariance()(6, 6), 0.09, 1e-9);
  // The magnitude is known in any world: no doubt along gravity.
  const Eigen::Vector3d along = filter.gravity_world().normalized();
  EXPECT_LT(along.dot(filter.covariance().block<3, 3>(15, 15) * along), 1e-4);
}

TEST(InertialFilter, ANewWorldTakesThePosesDoubtAndLeavesWhatTheBodyKnows) {
  const auto samples =
      RestingSamples(400, ExpSo3({0.1, -0.05, 0.4}), {0.01, 0.02, 0.0}, Eigen::Vector3d::Zero());
  InertialFilter filter = RestingFilter(samples);
  filter.AbsorbVelocity({0.5, 0.1, 0.0}, 0.01);
  filter.PropagateBlindly(AddSeconds(filter.state().time, 0.5));
  // Velocity and gravity in the body's axes are what they were, and so is the doubt of them.
  const auto in_body = [&] {
    const Eigen::Matrix3d R_imu_world =
        filter.state().T_world_imu.rotation.conjugate().toRotationMatrix();
    Eigen::Matrix<double, 6, InertialFilter::kSize> jacobian;
    jacobian.setZero();
    jacobian.block<3, 3>(0, 0) = Hat(R_imu_world * filter.state().v_world_imu);
    jacobian.block<3, 3>(0, 6) = R_imu_world;
    jacobian.block<3, 3>(3, 0) = Hat(R_imu_world * filter.gravity_world());
    jacobian.block<3, 3>(3, 15) = R_imu_world;
    return Matrix6d(jacobian * filter.covariance() * jacobian.transpose());
  };
  const Matrix6d known = in_body();
  const Matrix6d pose = filter.PoseCovariance();
  const SE3 T_world_imu = filter.state().T_world_imu;
  ASSERT_GT(pose.diagonal().head<3>().minCoeff(), 1e-2);
  EXPECT_LT((filter.BeginWorld() - pose).norm(), 1e-12);
  EXPECT_LT(filter.PoseCovariance().diagonal().maxCoeff(), 1e-7);
  EXPECT_LT((in_body() - known).norm(), 1e-6);
  EXPECT_LT(Minus(filter.state().T_world_imu, T_world_imu).norm(), 1e-12);
}

TEST(InertialFilter, DoubtGrowsWhileItIsBlind) {
  const auto samples = RestingSamples(400, Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero(),
                                      Eigen::Vector3d::Zero());
  InertialFilter filter = RestingFilter(samples);
  const double before = filter.PoseCovariance()(3, 3);
  filter.PropagateBlindly(AddSeconds(filter.state().time, 1.0));
  EXPECT_GT(filter.PoseCovariance()(3, 3), before + 0.2);
}

}  // namespace
}  // namespace regolith
