// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/cloud/downsample.h"

#include <gtest/gtest.h>

namespace regolith {
namespace {

TEST(Downsample, KeepsTheFirstPointOfEachVoxelInOrder) {
  const std::vector<Eigen::Vector3d> points = {
      {0.1, 0.1, 0.1}, {5.0, 0.0, 0.0}, {0.9, 0.9, 0.9}, {-0.1, 0.1, 0.1}, {5.5, 0.5, 0.5}};
  EXPECT_EQ(DownsampleIndices(points, 1.0), (std::vector<uint32_t>{0, 1, 3}));
  EXPECT_TRUE(DownsampleIndices({}, 1.0).empty());
}

}  // namespace
}  // namespace regolith
