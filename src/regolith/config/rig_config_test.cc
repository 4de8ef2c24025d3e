// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/rig_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

using testing::AllOf;
using testing::HasSubstr;

RigCalibration Example() {
  RigCalibration rig;
  rig.gravity = 1.62;
  rig.imu.emplace().noise.gyro_density = 3e-4;
  rig.lidar.emplace().T_imu_lidar = {ExpSo3({0.0, 0.1, 0.2}), {0.1, 0.0, 0.4}};
  CameraCalibration& camera = rig.cameras["mono"];
  camera.topic = "/camera/mono/image_raw";
  camera.intrinsics.width = 640;
  camera.intrinsics.height = 480;
  camera.intrinsics.focal = {381.0, 382.0};
  camera.intrinsics.principal_point = {319.5, 239.5};
  camera.intrinsics.distortion = {-0.1, 0.01, 1e-4, 2e-4};
  return rig;
}

std::string ErrorOf(const std::string& text) {
  try {
    LoadRig(YamlDocument::FromText(text, "rig.yaml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(RigConfig, WrittenRigReadsBackAsTheSame) {
  const RigCalibration rig = LoadRig(YamlDocument::FromText(WriteRig(Example()), "rig.yaml"));
  EXPECT_EQ(rig.gravity, 1.62);
  EXPECT_EQ(rig.imu->noise.gyro_density, 3e-4);
  EXPECT_LT((rig.lidar->T_imu_lidar.Matrix() - Example().lidar->T_imu_lidar.Matrix()).norm(),
            1e-12);
  EXPECT_EQ(rig.cameras.at("mono").intrinsics.focal, Eigen::Vector2d(381.0, 382.0));
  EXPECT_EQ(rig.cameras.at("mono").intrinsics.distortion,
            Example().cameras["mono"].intrinsics.distortion);
  EXPECT_FALSE(rig.wheels.has_value());
}

TEST(RigConfig, MasksLieBesideTheRig) {
  RigCalibration rig = Example();
  EXPECT_EQ(WriteRig(rig).find(" mask: "), std::string::npos);
  rig.cameras["mono"].mask_file = "masks/mono.png";
  const RigCalibration read =
      LoadRig(YamlDocument::FromText(WriteRig(rig), "/data/rover/rig.yaml"));
  EXPECT_EQ(read.cameras.at("mono").mask_file, "/data/rover/masks/mono.png");
  const RigCalibration copy =
      LoadRig(YamlDocument::FromText(WriteRig(read), "/elsewhere/rig.yaml"));
  EXPECT_EQ(copy.cameras.at("mono").mask_file, "/data/rover/masks/mono.png");
}

TEST(RigConfig, NamesFileAndKeyOfWrongValues) {
  EXPECT_THAT(ErrorOf("gravity: 0.165\nimu: {rate: 200}\n"),
              AllOf(HasSubstr("rig.yaml"), HasSubstr("gravity"), HasSubstr("m/s²")));
  EXPECT_THAT(ErrorOf("imu: {rate: 200}\n"), HasSubstr("gravity"));
  EXPECT_THAT(ErrorOf("gravity: 1.62\ngravitas: 2\n"), HasSubstr("rig.yaml:2"));
  EXPECT_THAT(ErrorOf("cameras:\n  mono: {model: wide}\n"), HasSubstr("kannala_brandt"));
  EXPECT_THAT(ErrorOf("cameras:\n  mono: {model: pinhole}\n"), HasSubstr("cameras.mono"));
}

}  // namespace
}  // namespace regolith
