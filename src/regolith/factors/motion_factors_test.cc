// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "regolith/factors/imu_factor.h"
#include "regolith/factors/test_jacobians_internal.h"
#include "regolith/factors/wheel_motion_factor.h"
#include "regolith/factors/zero_velocity_factor.h"
#include "regolith/imu/propagation.h"

namespace regolith {
namespace {

constexpr double kGravity = 1.62;

ImuPreintegration TurningMotion() {
  ImuPreintegration motion(ImuNoise(), {0.001, -0.002, 0.001}, {0.02, 0.01, -0.03});
  ImuSample from;
  from.angular_velocity = {0.1, -0.2, 0.4};
  from.specific_force = {0.3, -0.2, 1.7};
  for (int i = 1; i <= 100; ++i) {
    ImuSample to = from;
    to.time = FromSeconds(0.005 * i);
    to.specific_force.x() = 0.3 + 0.002 * i;
    motion.Integrate(from, to);
    from = to;
  }
  return motion;
}

NavState SomeState() {
  NavState state;
  state.T_world_imu = SE3(ExpSo3({0.05, -0.1, 1.2}), {2.0, -1.0, 0.3});
  state.v_world_imu = {0.4, 0.2, -0.05};
  state.gyro_bias = {0.002, -0.001, 0.001};
  state.accelerometer_bias = {0.03, 0.02, -0.02};
  return state;
}

TEST(ImuFactor, IsZeroForThePropagatedState) {
  const ImuPreintegration motion = TurningMotion();
  const Eigen::Vector2d tilt(0.02, -0.01);
  const NavState from = SomeState();
  const NavState to = motion.Predict(from, GravityFromTilt(tilt, kGravity));
  const ImuFactor factor(motion, kGravity);
  EXPECT_LT(ResidualsOf(factor, {ToPoseBlock(from.T_world_imu), ToMotionBlock(from),
                                 ToPoseBlock(to.T_world_imu), ToMotionBlock(to), tilt})
                .norm(),
            1e-6);
}

TEST(ImuFactor, JacobiansAreThoseOfTheResiduals) {
  const ImuPreintegration motion = TurningMotion();
  const Eigen::Vector2d tilt(0.02, -0.01);
  const NavState from = SomeState();
  NavState to = motion.Predict(from, GravityFromTilt(tilt, kGravity));
  to.T_world_imu = Plus(to.T_world_imu, 0.01 * Vector6d::Ones());
  to.v_world_imu += Eigen::Vector3d(0.02, 0.01, -0.03);
  ExpectJacobiansMatch(ImuFactor(motion, kGravity),
                       {ToPoseBlock(from.T_world_imu), ToMotionBlock(from),
                        ToPoseBlock(to.T_world_imu), ToMotionBlock(to), tilt},
                       2e-5);
}

TEST(GravityTilt, KeepsItsMagnitude) {
  EXPECT_NEAR(GravityFromTilt({0.3, -0.2}, kGravity).norm(), kGravity, 1e-12);
  EXPECT_LT((GravityFromTilt({0.0, 0.0}, kGravity) - Eigen::Vector3d(0.0, 0.0, -kGravity)).norm(),
            1e-12);
}

TEST(WheelMotionFactor, SlipIsTheShareThatTheWheelsSayTooMuch) {
  const SE3 T_imu_base(ExpSo3({0.0, 0.02, 0.1}), {-0.2, 0.1, -0.8});
  const SE3 T_world_i(ExpSo3({0.1, -0.05, 0.7}), {1.0, 2.0, 0.5});
  const SE3 T_world_base_i = T_world_i * T_imu_base;
  const SE3 T_world_base_j = T_world_base_i * SE3(ExpSo3({0.02, 0.01, 0.2}), {0.45, 0.02, 0.01});
  const SE3 T_world_j = T_world_base_j * T_imu_base.Inverse();
  Eigen::Matrix3d root = Eigen::Vector3d(50.0, 40.0, 30.0).asDiagonal();
  root(0, 2) = 3.0;
  const Eigen::Vector3d way(0.5, 0.02 / 0.9, 0.01 / 0.9);
  const WheelMotionFactor factor(T_imu_base, way, root);
  const std::vector<Eigen::VectorXd> values = {ToPoseBlock(T_world_i), ToPoseBlock(T_world_j),
                                               Eigen::VectorXd::Constant(1, 0.1)};
  EXPECT_LT(ResidualsOf(factor, values).norm(), 1e-9);
  ExpectJacobiansMatch(factor, values, 1e-6);
}

TEST(ZeroVelocityFactor, JacobiansAreThoseOfTheResiduals) {
  ExpectJacobiansMatch(ZeroVelocityFactor(0.01), {ToMotionBlock(SomeState())}, 1e-8);
}

}  // namespace
}  // namespace regolith
