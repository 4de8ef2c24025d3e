// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

using Pairs = std::vector<std::pair<size_t, size_t>>;

Pairs PairsTenMetresApart(const std::vector<double>& positions) {
  std::vector<SE3> poses;
  for (const double x : positions) {
    poses.emplace_back(Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0.0, 0.0));
  }
  Pairs pairs;
  for (const SegmentEnds& ends : PairsByPathLength(poses, 10.0, 0.1)) {
    pairs.emplace_back(ends.from, ends.to);
  }
  return pairs;
}

// The expected pairs are those of evo_rpe 1.38.1 --delta 10 --delta_unit m --all_pairs.
TEST(PairsByPathLength, AreThoseOfEvo) {
  EXPECT_EQ(PairsTenMetresApart({0, 3, 9.2, 10.5, 12, 19.5, 20, 22, 31, 40}),
            (Pairs{{0, 3}, {1, 4}, {2, 5}, {3, 6}, {4, 7}, {6, 8}, {7, 8}, {8, 9}}));
  EXPECT_EQ(PairsTenMetresApart({0, 9.5, 10.5, 30}), (Pairs{{0, 1}}));
  EXPECT_EQ(PairsTenMetresApart({0, 9, 30}), (Pairs{{0, 1}}));
  EXPECT_EQ(PairsTenMetresApart({0, 11, 40}), (Pairs{{0, 1}}));
  EXPECT_EQ(PairsTenMetresApart({0, 8.99, 40}), Pairs{});
  EXPECT_EQ(PairsTenMetresApart({0, 5, 9, 5, 0, 3, 10}), (Pairs{{0, 2}, {2, 4}, {4, 6}}));
  EXPECT_EQ(PairsTenMetresApart({0, 0, 0, 10, 10, 10, 20}),
            (Pairs{{0, 3}, {1, 3}, {2, 3}, {3, 6}, {4, 6}, {5, 6}}));
  EXPECT_EQ(PairsTenMetresApart({}), Pairs{});
}

TEST(RelativePoseErrors, IgnoreAFixedFrameAndSeeAScaleAndATurn) {
  const SE3 T_other_world(ExpSo3({0.1, 0.7, -2.0}), {4.0, 5.0, 6.0});
  std::vector<SE3> reference;
  std::vector<SE3> moved;
  std::vector<SE3> wrong;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d position(2.0 * i, 0.0, 0.0);
    reference.emplace_back(Eigen::Quaterniond::Identity(), position);
    moved.push_back(T_other_world * reference.back());
    wrong.emplace_back(ExpSo3({0.0, 0.0, 0.01 * i}), position);
  }
  const std::vector<SegmentEnds> steps = ConsecutivePairs(reference.size());
  ASSERT_EQ(steps.size(), 4U);
  const PoseErrors none = RelativePoseErrors(reference, moved, steps);
  const PoseErrors turned = RelativePoseErrors(reference, wrong, steps);
  for (size_t i = 0; i < steps.size(); ++i) {
    EXPECT_NEAR(none.translation[i], 0.0, 1e-12);
    EXPECT_NEAR(none.angle[i], 0.0, 1e-12);
    EXPECT_NEAR(turned.angle[i], 0.01, 1e-12);
    // A step of 2 m seen from a heading that is off by 0.01 i.
    EXPECT_NEAR(turned.translation[i], 2.0 * 2.0 * std::sin(0.005 * static_cast<double>(i)), 1e-12);
  }
}

TEST(AbsolutePoseErrors, AreDistancesAndAngles) {
  const std::vector<SE3> reference = {SE3()};
  const std::vector<SE3> estimate = {SE3(ExpSo3({0.0, 0.3, 0.0}), {3.0, 0.0, 4.0})};
  const PoseErrors errors = AbsolutePoseErrors(reference, estimate);
  EXPECT_NEAR(errors.translation[0], 5.0, 1e-12);
  EXPECT_NEAR(errors.angle[0], 0.3, 1e-12);
}

}  // namespace
}  // namespace regolith
