// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sensor/rig_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/core/error.h"

namespace regolith {
namespace {

using testing::HasSubstr;

template <typename Action>
std::string ErrorOf(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

RigCalibration ValidRig() {
  RigCalibration rig;
  rig.gravity = 1.62;
  rig.imu.emplace();
  rig.lidar.emplace();
  return rig;
}

TEST(RigCalibration, AcceptsMoonMarsAndEarth) {
  for (const double gravity : {1.62, 3.72, 9.81}) {
    RigCalibration rig = ValidRig();
    rig.gravity = gravity;
    EXPECT_NO_THROW(rig.Check()) << gravity;
  }
}

TEST(RigCalibration, RefusesGravityInMultiplesOfG) {
  for (const double gravity : {1.0, 0.165, 0.38, -9.81}) {
    RigCalibration rig = ValidRig();
    rig.gravity = gravity;
    EXPECT_THAT(ErrorOf([&] { rig.Check(); }), HasSubstr("gravity")) << gravity;
  }
}

TEST(RigCalibration, NamesTheKeyThatIsOutOfBounds) {
  RigCalibration rig = ValidRig();
  rig.lidar->max_range = 0.1;
  EXPECT_THAT(ErrorOf([&] { rig.Check(); }), HasSubstr("lidar.max_range"));
  rig = ValidRig();
  rig.imu->noise.gyro_density = 17.0;
  EXPECT_THAT(ErrorOf([&] { rig.Check(); }), HasSubstr("imu.gyro_density"));
}

TEST(TransformFromMatrix, TellsReflectionScaleAndTransposeApart) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  EXPECT_NO_THROW(TransformFromMatrix(matrix));
  matrix(1, 1) = -1.0;
  EXPECT_THAT(ErrorOf([&] { TransformFromMatrix(matrix); }), HasSubstr("reflected"));
  matrix(1, 1) = 2.0;
  EXPECT_THAT(ErrorOf([&] { TransformFromMatrix(matrix); }), HasSubstr("not a rotation"));
  matrix = Eigen::Matrix4d::Identity();
  matrix(3, 0) = 0.5;
  EXPECT_THAT(ErrorOf([&] { TransformFromMatrix(matrix); }), HasSubstr("transposed"));
}

}  // namespace
}  // namespace regolith
