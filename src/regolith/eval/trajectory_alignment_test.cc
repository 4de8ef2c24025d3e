// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/trajectory_alignment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

std::vector<StampedPose> Spiral() {
  std::vector<StampedPose> poses;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.2 * i;
    poses.push_back(
        {FromSeconds(0.1 * i),
         SE3(ExpSo3({0.1, 0.0, angle}), {angle * std::cos(angle), std::sin(angle), 0.05 * i})});
  }
  return poses;
}

std::vector<StampedPose> Moved(std::vector<StampedPose> poses, const SE3& T_other_world,
                               double scale) {
  for (StampedPose& pose : poses) {
    pose.T_world_body = T_other_world * pose.T_world_body;
    pose.T_world_body.translation *= scale;
  }
  return poses;
}

double LargestDistance(const Alignment& alignment, const std::vector<StampedPose>& reference,
                       const std::vector<StampedPose>& estimate) {
  double largest = 0.0;
  for (size_t i = 0; i < reference.size(); ++i) {
    const Eigen::Vector3d aligned =
        alignment.scale * (alignment.T_target_source * estimate[i].T_world_body.translation);
    largest = std::max(largest, (aligned - reference[i].T_world_body.translation).norm());
  }
  return largest;
}

TEST(TrajectoryAlignment, YawTakesAwayHeadingAndPlaceAlone) {
  const std::vector<StampedPose> reference = Spiral();
  const SE3 turn(ExpSo3({0.0, 0.0, 2.5}), {10.0, -3.0, 1.0});
  const std::vector<StampedPose> estimate = Moved(reference, turn, 1.0);
  const auto alignment = AlignTrajectory(reference, estimate, AlignmentMode::kYaw);
  ASSERT_TRUE(alignment);
  EXPECT_LT(LargestDistance(*alignment, reference, estimate), 1e-9);

  const SE3 tilt(ExpSo3({0.2, 0.0, 0.3}), Eigen::Vector3d::Zero());
  const std::vector<StampedPose> tilted = Moved(reference, tilt, 1.0);
  const auto level = AlignTrajectory(reference, tilted, AlignmentMode::kYaw);
  ASSERT_TRUE(level);
  EXPECT_NEAR(std::abs((level->T_target_source.rotation * Eigen::Vector3d::UnitZ()).z()), 1.0,
              1e-12);
  EXPECT_GT(LargestDistance(*level, reference, tilted), 0.1);
}

TEST(TrajectoryAlignment, OriginLaysTheFirstPosesTogether) {
  const std::vector<StampedPose> reference = Spiral();
  const SE3 motion(ExpSo3({0.4, -0.3, 1.0}), {1.0, 2.0, 3.0});
  const std::vector<StampedPose> estimate = Moved(reference, motion, 1.0);
  const auto alignment = AlignTrajectory(reference, estimate, AlignmentMode::kOrigin);
  ASSERT_TRUE(alignment);
  EXPECT_LT(Minus(alignment->T_target_source * estimate[0].T_world_body, reference[0].T_world_body)
                .norm(),
            1e-12);
  EXPECT_LT(LargestDistance(*alignment, reference, estimate), 1e-9);
}

TEST(TrajectoryAlignment, FindsTheScale) {
  const std::vector<StampedPose> reference = Spiral();
  EXPECT_NEAR(*FitScale(reference, Moved(reference, SE3(), 1.25)), 0.8, 1e-12);
}

TEST(TrajectoryAlignment, SaysWhenNothingIsDetermined) {
  std::vector<StampedPose> vertical = Spiral();
  for (size_t i = 0; i < vertical.size(); ++i) {
    vertical[i].T_world_body.translation = {0.0, 0.0, 0.1 * static_cast<double>(i)};
  }
  EXPECT_FALSE(AlignTrajectory(vertical, vertical, AlignmentMode::kYaw));
  EXPECT_FALSE(AlignTrajectory(vertical, vertical, AlignmentMode::kSe3));
  EXPECT_TRUE(AlignTrajectory(vertical, vertical, AlignmentMode::kOrigin));
  EXPECT_FALSE(FitScale(vertical, vertical));
  EXPECT_THROW(AlignTrajectory(vertical, {}, AlignmentMode::kNone), CheckError);
}

}  // namespace
}  // namespace regolith
