// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/wheel_slip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/core/random.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

TEST(WheelSlip, LearnsMeanAndSpread) {
  Random random(1);
  WheelSlip slip{WheelSlipOptions()};
  double mean_slip = 0.0;
  double mean_sigma = 0.0;
  for (int i = 0; i < 400; ++i) {
    slip.Observe(1.0 + random.Gaussian(0.08, 0.03), 1.0);
    if (i < 200) continue;
    mean_slip += slip.slip() / 200.0;
    mean_sigma += slip.sigma() / 200.0;
  }
  EXPECT_NEAR(mean_slip, 0.08, 0.01);
  EXPECT_NEAR(mean_sigma, 0.03, 0.008);
}

TEST(WheelSlip, AStuckWheelDoesNotSpoilIt) {
  WheelSlip slip{WheelSlipOptions()};
  for (int i = 0; i < 100; ++i) slip.Observe(1.05, 1.0);
  slip.Observe(5.0, 1.0);
  EXPECT_LT(std::abs(slip.slip() - 0.05), 0.01);
  // On a slope it does rise.
  for (int i = 0; i < 40; ++i) slip.Observe(1.35, 1.0);
  EXPECT_NEAR(slip.slip(), 0.35, 0.05);
  slip.Observe(0.01, 0.0);
  EXPECT_NEAR(slip.slip(), 0.35, 0.05);
}

TEST(WheelSlip, TheMotionIsThatOfTheBody) {
  WheelSlip slip{WheelSlipOptions()};
  for (int i = 0; i < 200; ++i) slip.Observe(1.25, 1.0);
  const SE3 T_body_base(ExpSo3({0.0, 0.0, 1.5707963267948966}), {0.0, 0.0, -1.0});
  WheelDelta delta;
  delta.T_from_to.translation = {1.25, 0.0, 0.0};
  delta.distance = 1.25;
  delta.covariance = Matrix6d::Identity() * 1e-6;
  const UncertainPose motion = slip.Correct(delta, T_body_base);
  EXPECT_LT((motion.T_a_b.translation - Eigen::Vector3d(0.0, 1.0, 0.0)).norm(), 1e-3);
  // Along the track, the body's y axis, it is as unsure as slip; across as the wheels said.
  EXPECT_NEAR(std::sqrt(motion.covariance(4, 4)), slip.sigma(), 2e-3);
  EXPECT_LT(std::sqrt(motion.covariance(3, 3)), 3e-3);
}

}  // namespace
}  // namespace regolith
