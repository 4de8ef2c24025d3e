// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/geometry/trajectory.h"

#include <gtest/gtest.h>

#include "regolith/core/check.h"

namespace regolith {
namespace {

StampedPose PoseAt(TimeNs time, double x) {
  return {time, SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0.0, 0.0))};
}

TEST(Trajectory, InterpolatesInsideAndRefusesOutside) {
  const Trajectory trajectory({PoseAt(0, 0.0), PoseAt(1000, 1.0), PoseAt(3000, 5.0)});
  EXPECT_DOUBLE_EQ(trajectory.At(0)->translation.x(), 0.0);
  EXPECT_DOUBLE_EQ(trajectory.At(2000)->translation.x(), 3.0);
  EXPECT_DOUBLE_EQ(trajectory.At(3000)->translation.x(), 5.0);
  EXPECT_FALSE(trajectory.At(-1).has_value());
  EXPECT_FALSE(trajectory.At(3001).has_value());
  EXPECT_FALSE(Trajectory().At(0).has_value());
}

TEST(Trajectory, LengthSumsTheSteps) {
  EXPECT_DOUBLE_EQ(Trajectory({PoseAt(0, 0.0), PoseAt(1, 2.0), PoseAt(2, 1.0)}).Length(), 3.0);
}

TEST(Trajectory, RefusesTimesThatDoNotIncrease) {
  EXPECT_THROW(Trajectory({PoseAt(5, 0.0), PoseAt(5, 1.0)}), CheckError);
  Trajectory trajectory({PoseAt(5, 0.0)});
  EXPECT_THROW(trajectory.Append(PoseAt(4, 0.0)), CheckError);
}

}  // namespace
}  // namespace regolith
