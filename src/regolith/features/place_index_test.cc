// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/place_index.h"

#include <gtest/gtest.h>

#include "regolith/core/random.h"

namespace regolith {
namespace {

/// Descriptors of one place: each a few bits from one of the kinds that all places have, which a
/// place has in its own way.
Descriptors Place(uint64_t place, uint64_t visit) {
  Random random(place * 1000 + visit);
  Descriptors descriptors;
  descriptors.type = DescriptorType::kBinary;
  for (uint64_t i = 0; i < 300; ++i) {
    const uint64_t kind = i % 12;
    for (uint64_t byte = 0; byte < kBinaryBytes; ++byte) {
      const uint64_t of_kind = Scramble(kind * 100 + byte);
      const uint64_t own = Scramble(place * 77777 + i * 100 + byte) & Scramble(i + byte);
      const uint64_t noise = random.Next() & random.Next() & random.Next();
      descriptors.bits.push_back(static_cast<uint8_t>(of_kind ^ (own & 0x5A) ^ (noise & 0x11)));
    }
  }
  return descriptors;
}

TEST(PlaceIndex, FindsThePlaceAgain) {
  PlaceIndex index;
  for (int64_t place = 0; place < 30; ++place) {
    index.Add(place, Place(static_cast<uint64_t>(place), 0));
  }
  ASSERT_TRUE(index.has_vocabulary());
  EXPECT_GT(index.Global(0).size(), 0);
  for (const uint64_t place : {uint64_t{2}, uint64_t{11}, uint64_t{25}}) {
    EXPECT_EQ(index.MostSimilar(Place(place, 1), 1).front(), static_cast<int64_t>(place));
  }
  index.Remove(11);
  EXPECT_NE(index.MostSimilar(Place(11, 1), 1).front(), 11);
}

TEST(PlaceIndex, WithoutAVocabularyTheNewestComeFirst) {
  PlaceIndex index;
  for (int64_t place = 0; place < 4; ++place) {
    index.Add(place, Place(static_cast<uint64_t>(place), 0));
  }
  EXPECT_FALSE(index.has_vocabulary());
  const std::vector<int64_t> found = index.MostSimilar(Place(1, 1), 2);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0], 3);
}

TEST(PlaceIndex, CentroidsAreThoseOfTheGroups) {
  Eigen::MatrixXf columns(3, 40);
  for (Eigen::Index i = 0; i < 40; ++i) {
    Eigen::Vector3f column = Eigen::Vector3f::Unit(i % 2);
    column.z() = 0.02F * static_cast<float>(i % 5);
    columns.col(i) = column.normalized();
  }
  const Eigen::MatrixXf centroids = SphericalCentroids(columns, 2);
  EXPECT_NEAR(centroids.col(0).dot(centroids.col(1)), 0.0, 0.02);
}

}  // namespace
}  // namespace regolith
