// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sensor/camera_model.h"

#include <gtest/gtest.h>

#include "regolith/core/error.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

CameraIntrinsics Intrinsics(CameraModelType model) {
  CameraIntrinsics intrinsics;
  intrinsics.model = model;
  intrinsics.width = 752;
  intrinsics.height = 480;
  intrinsics.focal = {458.654, 457.296};
  intrinsics.principal_point = {367.215, 248.375};
  if (model == CameraModelType::kPinhole) {
    intrinsics.distortion = {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05};  // EuRoC cam0
  } else if (model == CameraModelType::kKannalaBrandt) {
    intrinsics.width = 512;
    intrinsics.height = 512;
    intrinsics.principal_point = {254.93, 256.89};
    intrinsics.focal = {190.97, 190.97};
    intrinsics.distortion = {0.0034824, 0.00071503, -0.0020532, 0.00020293};  // TUM VI cam0
  }
  return intrinsics;
}

class CameraModelTest : public testing::TestWithParam<CameraModelType> {
 protected:
  std::unique_ptr<CameraModel> model_ = CameraModel::Create(Intrinsics(GetParam()));
};

TEST_P(CameraModelTest, ProjectInvertsUnprojectOverTheWholeImage) {
  for (int row = 0; row < model_->intrinsics().height; row += 7) {
    for (int column = 0; column < model_->intrinsics().width; column += 11) {
      const Eigen::Vector2d pixel(column, row);
      const auto bearing = model_->Unproject(pixel);
      ASSERT_TRUE(bearing.has_value()) << pixel.transpose();
      EXPECT_NEAR(bearing->norm(), 1.0, 1e-12);
      const auto projected = model_->Project(3.7 * *bearing);
      ASSERT_TRUE(projected.has_value()) << pixel.transpose();
      EXPECT_LT((*projected - pixel).norm(), 1e-6) << pixel.transpose();
    }
  }
}

TEST_P(CameraModelTest, JacobianMatchesNumericDifferences) {
  Random random(8);
  for (int i = 0; i < 50; ++i) {
    const auto bearing = model_->Unproject({random.Uniform(0, 500), random.Uniform(0, 470)});
    const Eigen::Vector3d point = random.Uniform(0.5, 30.0) * *bearing;
    Eigen::Matrix<double, 2, 3> jacobian;
    ASSERT_TRUE(model_->Project(point, &jacobian).has_value());
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector2d numeric =
          (*model_->Project(point + step) - *model_->Project(point - step)) / 2e-6;
      EXPECT_LT((numeric - jacobian.col(axis)).norm(), 1e-4 * (1.0 + jacobian.norm()));
    }
  }
}

TEST_P(CameraModelTest, TheAxisMeetsThePrincipalPoint) {
  Eigen::Matrix<double, 2, 3> jacobian;
  const auto pixel = model_->Project({0.0, 0.0, 2.0}, &jacobian);
  ASSERT_TRUE(pixel.has_value());
  EXPECT_LT((*pixel - model_->intrinsics().principal_point).norm(), 1e-9);
  EXPECT_NEAR(jacobian(0, 0), model_->intrinsics().focal.x() / 2.0, 1e-9);
}

TEST_P(CameraModelTest, PointsBehindHaveNoPixel) {
  EXPECT_FALSE(model_->Project({0.0, 0.0, -1.0}).has_value());
  EXPECT_FALSE(model_->Project({0.0, 0.0, 0.0}).has_value());
}

INSTANTIATE_TEST_SUITE_P(Models, CameraModelTest,
                         testing::Values(CameraModelType::kPinhole, CameraModelType::kEquidistant,
                                         CameraModelType::kKannalaBrandt),
                         [](const auto& name) { return CameraModelName(name.param); });

TEST(CameraModel, PinholeMatchesBrownsFormulaByHand) {
  CameraIntrinsics intrinsics = Intrinsics(CameraModelType::kPinhole);
  intrinsics.distortion = {0.1, 0.01, 0.001, 0.002};
  const auto pixel = CameraModel::Create(intrinsics)->Project({0.2, -0.1, 1.0});
  // r² = 0.05: radial 1.005025; x' = 0.201005 - 0.00004 + 0.00026, y' = -0.1005025 + 0.00007 -
  // 0.00008.
  EXPECT_NEAR(pixel->x(), 458.654 * 0.201225 + 367.215, 1e-6);
  EXPECT_NEAR(pixel->y(), 457.296 * -0.1005125 + 248.375, 1e-6);
}

TEST(CameraModel, RefusesWhatMakesNoCamera) {
  CameraIntrinsics intrinsics = Intrinsics(CameraModelType::kPinhole);
  intrinsics.focal.x() = -1.0;
  EXPECT_THROW(CameraModel::Create(intrinsics), InputError);
  intrinsics = Intrinsics(CameraModelType::kPinhole);
  intrinsics.principal_point.x() = 4000.0;
  EXPECT_THROW(CameraModel::Create(intrinsics), InputError);
  intrinsics = Intrinsics(CameraModelType::kPinhole);
  intrinsics.distortion = {-2.0, 0.0, 0.0, 0.0};
  EXPECT_THROW(CameraModel::Create(intrinsics), InputError);
}

}  // namespace
}  // namespace regolith
