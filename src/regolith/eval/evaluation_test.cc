// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/error.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

using ::testing::HasSubstr;

/// A circle of 5 m radius, 10 Hz, 0.1 rad and so 0.5 m a pose.
std::vector<StampedPose> Circle(int count) {
  std::vector<StampedPose> poses;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.1 * i;
    poses.push_back({FromSeconds(0.1 * i),
                     SE3(ExpSo3({0, 0, angle}), {5.0 * std::cos(angle), 5.0 * std::sin(angle),
                                                 0.1 * std::sin(3 * angle)})});
  }
  return poses;
}

std::string ErrorOf(const std::vector<StampedPose>& reference,
                    const std::vector<StampedPose>& estimate) {
  try {
    EvaluateTrajectory({"truth.tum", reference}, {"mine.tum", estimate}, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Evaluation, AlignsAwayWhatTheModeAllows) {
  const std::vector<StampedPose> reference = Circle(60);
  std::vector<StampedPose> estimate = reference;
  const SE3 T_other_world(ExpSo3({0.2, -0.1, 1.0}), {10.0, 20.0, 30.0});
  for (StampedPose& pose : estimate) {
    pose.T_world_body = T_other_world * pose.T_world_body;
    pose.T_world_body.translation *= 1.1;
  }
  EvaluationOptions options;
  options.alignment = AlignmentMode::kSim3;
  const Evaluation similar = EvaluateTrajectory({"r", reference}, {"e", estimate}, options);
  EXPECT_NEAR(similar.ape.max, 0.0, 1e-12);
  EXPECT_NEAR(similar.alignment.scale, 1.0 / 1.1, 1e-12);
  EXPECT_NEAR(similar.rotation_deg, 0.0, 1e-6);

  const std::vector<StampedPose> moved = ReferenceInEstimateFrame(reference, similar.alignment);
  EXPECT_LT(Minus(moved[7].T_world_body, estimate[7].T_world_body).norm(), 1e-9);

  options.alignment = AlignmentMode::kSe3;
  const Evaluation rigid = EvaluateTrajectory({"r", reference}, {"e", estimate}, options);
  EXPECT_EQ(rigid.matched, 60U);
  EXPECT_NEAR(rigid.ape.rmse, 0.5, 0.02);
  // A tenth of the chord under 9 m of arc (10 m in the swollen estimate), over 10 m.
  EXPECT_NEAR(*rigid.drift_percent, 10.0 * std::sin(0.9), 0.05);
  EXPECT_NEAR(*rigid.percent_of_distance, 100.0 * rigid.ape.rmse / rigid.length_m, 1e-12);

  options.alignment = AlignmentMode::kNone;
  EXPECT_GT(EvaluateTrajectory({"r", reference}, {"e", estimate}, options).ape.min, 10.0);
}

TEST(Evaluation, HasNoDriftOnAPathBelowTenMetres) {
  const std::vector<StampedPose> reference = Circle(10);
  const Evaluation evaluation = EvaluateTrajectory({"r", reference}, {"e", reference}, {});
  EXPECT_FALSE(evaluation.rpe_10m.has_value());
  EXPECT_FALSE(evaluation.drift_percent.has_value());
  EXPECT_FALSE(evaluation.rotation_deg_per_m.has_value());
}

TEST(Evaluation, TellsAxesAndHeadingApart) {
  const std::vector<StampedPose> reference = Circle(60);
  std::vector<StampedPose> estimate = reference;
  for (size_t i = 0; i < estimate.size(); ++i) {
    SE3& pose = estimate[i].T_world_body;
    pose.translation += Eigen::Vector3d(0.3, -0.2, i % 2 == 0 ? 0.1 : -0.1);
    pose.rotation = ExpSo3({0.0, 0.0, i == 7 ? 3.1 : 0.05}) * pose.rotation;
  }
  EvaluationOptions options;
  options.alignment = AlignmentMode::kNone;
  const Evaluation evaluation = EvaluateTrajectory({"r", reference}, {"e", estimate}, options);
  EXPECT_NEAR(evaluation.axes[0].rmse, 0.3, 1e-12);
  EXPECT_NEAR(evaluation.axes[1].max, 0.2, 1e-12);
  EXPECT_NEAR(evaluation.axes[2].mean, 0.1, 1e-12);
  EXPECT_NEAR(evaluation.offsets_m[3].z(), -0.1, 1e-12);
  EXPECT_NEAR(evaluation.yaw_deg[3], 0.05 * 180.0 / M_PI, 1e-9);
  EXPECT_NEAR(evaluation.yaw.max, 3.1 * 180.0 / M_PI, 1e-9);
  EXPECT_NEAR(*evaluation.fitted_scale, 1.0, 1e-3);
  EXPECT_NEAR(evaluation.distance_m.back(), evaluation.length_m, 1e-9);
  EXPECT_NEAR(evaluation.time_coverage, 1.0, 1e-12);
}

TEST(Evaluation, CoverageLeavesOutWhereTheEstimateWasLost) {
  const std::vector<StampedPose> reference = Circle(101);
  std::vector<StampedPose> estimate = reference;
  estimate.erase(estimate.begin() + 21, estimate.begin() + 60);
  const Evaluation evaluation = EvaluateTrajectory({"r", reference}, {"e", estimate}, {});
  EXPECT_NEAR(evaluation.time_coverage, 0.6, 1e-9);
}

TEST(Evaluation, SaysWhatIsWrongWithTheFiles) {
  const std::vector<StampedPose> good = Circle(20);
  EXPECT_EQ(ErrorOf(good, good), "");
  EXPECT_THAT(ErrorOf(good, {}), HasSubstr("mine.tum: has no poses"));

  std::vector<StampedPose> later = good;
  for (StampedPose& pose : later) pose.time += FromSeconds(1000.0);
  EXPECT_THAT(ErrorOf(good, later), HasSubstr("only 0 poses lie within 0.02 s"));

  std::vector<StampedPose> backwards = good;
  std::swap(backwards[4], backwards[5]);
  EXPECT_THAT(ErrorOf(backwards, good), HasSubstr("truth.tum: stamps run backwards at pose 6"));

  std::vector<StampedPose> broken = good;
  broken[2].T_world_body.translation.x() = std::nan("");
  EXPECT_THAT(ErrorOf(good, broken), HasSubstr("mine.tum: pose 3 at 0.200000 s is not finite"));

  std::vector<StampedPose> still = good;
  for (StampedPose& pose : still) pose.T_world_body.translation.setZero();
  EXPECT_THAT(ErrorOf(good, still), HasSubstr("lie on one line"));
  EXPECT_THAT(ErrorOf(good, Circle(2)), HasSubstr("only 2 poses"));
}

}  // namespace
}  // namespace regolith
