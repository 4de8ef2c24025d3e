// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/network_extractor.h"

#include <gtest/gtest.h>

#include <vector>

namespace regolith {
namespace {

/// Descriptors whose direction is linear in the place: (1, 0.1 x, 0.1 y) in cells.
std::vector<float> LinearField(int columns, int rows) {
  std::vector<float> values;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      values.insert(values.end(),
                    {1.0F, 0.1F * static_cast<float>(column), 0.1F * static_cast<float>(row)});
    }
  }
  return values;
}

TEST(SampleDescriptors, IsBilinearBetweenTheCentresOfCells) {
  const std::vector<float> field = LinearField(5, 4);
  NetworkOutput output;
  output.columns = 5;
  output.rows = 4;
  output.dimension = 3;
  output.descriptors = field.data();
  Descriptors sampled;
  SampleDescriptors(
      output, {{3.5F, 3.5F}, {3.5F + 8.0F * 1.25F, 3.5F + 8.0F * 2.5F}, {39.0F, 0.0F}}, &sampled);
  ASSERT_EQ(sampled.size(), 3U);
  const std::vector<Eigen::Vector3f> expected = {
      Eigen::Vector3f(1.0F, 0.0F, 0.0F), Eigen::Vector3f(1.0F, 0.125F, 0.25F).normalized(),
      Eigen::Vector3f(1.0F, 0.4F, 0.0F).normalized()};  // beyond the last centre: the edge's
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_LT((Eigen::Map<const Eigen::Vector3f>(sampled.Row(i)) - expected[i]).norm(), 1e-6F) << i;
  }
}

}  // namespace
}  // namespace regolith
