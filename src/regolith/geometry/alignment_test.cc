// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/geometry/alignment.h"

#include <gtest/gtest.h>

#include <vector>

#include "regolith/core/random.h"

namespace regolith {
namespace {

std::vector<Eigen::Vector3d> RandomPoints(int count, bool planar) {
  Random random(4);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.Gaussian(), random.Gaussian(), planar ? 0.0 : random.Gaussian());
  }
  return points;
}

TEST(Alignment, RecoversASimilarityAlsoFromPointsInOnePlane) {
  Vector6d tangent;
  tangent << 0.4, -1.1, 2.0, 3.0, -7.0, 11.0;
  const SE3 motion = ExpSe3(tangent);
  for (const bool planar : {false, true}) {
    const std::vector<Eigen::Vector3d> source = RandomPoints(20, planar);
    for (const double scale : {1.0, 2.5}) {
      std::vector<Eigen::Vector3d> target;
      for (const Eigen::Vector3d& point : source) target.push_back(scale * (motion * point));
      const auto alignment = AlignPoints(source, target, scale != 1.0);
      ASSERT_TRUE(alignment.has_value());
      EXPECT_NEAR(alignment->scale, scale, 1e-12);
      for (size_t i = 0; i < source.size(); ++i) {
        const Eigen::Vector3d moved = alignment->scale * (alignment->T_target_source * source[i]);
        EXPECT_LT((moved - target[i]).norm(), 1e-10);
      }
    }
  }
}

TEST(Alignment, RefusesTooFewPointsAndPointsOnALine) {
  const std::vector<Eigen::Vector3d> line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}};
  EXPECT_FALSE(AlignPoints(line, line, false).has_value());
  const std::vector<Eigen::Vector3d> two = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(AlignPoints(two, two, false).has_value());
}

}  // namespace
}  // namespace regolith
