// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/global_descriptor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "regolith/core/check.h"
#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr int kDimension = 64;
constexpr int kCells = 16;

Eigen::VectorXf RandomUnit(Random* random, int dimension = kDimension) {
  Eigen::VectorXf result(dimension);
  for (float& value : result) value = static_cast<float>(random->Gaussian());
  return result.normalized();
}

Descriptors ToDescriptors(const std::vector<Eigen::VectorXf>& columns) {
  Descriptors result;
  result.type = DescriptorType::kFloat;
  result.dimension = columns.empty() ? kDimension : static_cast<int>(columns[0].size());
  for (const Eigen::VectorXf& column : columns) {
    result.values.insert(result.values.end(), column.data(), column.data() + column.size());
  }
  return result;
}

std::vector<Eigen::VectorXf> RandomPlace(uint64_t seed, int size = 300) {
  Random random(seed);
  std::vector<Eigen::VectorXf> result;
  for (int i = 0; i < size; ++i) result.push_back(RandomUnit(&random));
  return result;
}

/// Means of the cells of many descriptors (Lloyd's iterations on the sphere).
GlobalDescriptor Vocabulary() {
  const std::vector<Eigen::VectorXf> examples = RandomPlace(98, 3000);
  Eigen::MatrixXf centroids(kDimension, kCells);
  for (int i = 0; i < kCells; ++i) centroids.col(i) = examples[static_cast<size_t>(i)];
  for (int round = 0; round < 5; ++round) {
    Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(kDimension, kCells);
    for (const Eigen::VectorXf& example : examples) {
      Eigen::Index nearest = 0;
      (centroids.transpose() * example).maxCoeff(&nearest);
      sums.col(nearest) += example;
    }
    centroids = sums.colwise().normalized();
  }
  return GlobalDescriptor(centroids);
}

TEST(GlobalDescriptor, IsTheNormalisedResidualOfEachCell) {
  Eigen::MatrixXf centroids(3, 2);
  centroids.col(0) = Eigen::Vector3f::UnitX();
  centroids.col(1) = Eigen::Vector3f::UnitY();
  const GlobalDescriptor vlad(centroids);
  const Eigen::Vector3f near_x(0.8F, 0.0F, 0.6F);
  const Eigen::VectorXf one = vlad.Describe(ToDescriptors({near_x}));
  ASSERT_EQ(one.size(), 6);
  EXPECT_EQ(vlad.size(), 6);
  EXPECT_TRUE(one.head<3>().isApprox(Eigen::Vector3f::UnitZ(), 1e-5F));
  EXPECT_TRUE(one.tail<3>().isZero(0.0F));
  // Both cells weigh the same however many descriptors they hold.
  const Eigen::VectorXf both =
      vlad.Describe(ToDescriptors({near_x, near_x, near_x, Eigen::Vector3f(0.0F, 0.6F, -0.8F)}));
  EXPECT_NEAR(both.norm(), 1.0F, 1e-5F);
  EXPECT_NEAR(both.head<3>().norm(), std::sqrt(0.5F), 1e-5F);
  EXPECT_NEAR(both.tail<3>().norm(), std::sqrt(0.5F), 1e-5F);
  // A centroid itself leaves nothing.
  EXPECT_TRUE(vlad.Describe(ToDescriptors({Eigen::Vector3f::UnitX()})).isZero(0.0F));
}

TEST(GlobalDescriptor, FindsThePlaceAgain) {
  const GlobalDescriptor vlad = Vocabulary();
  std::vector<Eigen::VectorXf> place = RandomPlace(1);
  const Eigen::VectorXf described = vlad.Describe(ToDescriptors(place));
  EXPECT_NEAR(described.norm(), 1.0F, 1e-5F);
  EXPECT_NEAR(Similarity(described, described), 1.0F, 1e-5F);

  Random random(5);
  for (size_t i = place.size() - 1; i > 0; --i) std::swap(place[i], place[random.Next() % (i + 1)]);
  for (size_t i = 0; i < place.size(); ++i) {
    // Every tenth is replaced, and all are noisy by 30 % of their length.
    if (i % 10 == 0) place[i] = RandomUnit(&random);
    place[i] = (place[i] + 0.3F * RandomUnit(&random)).normalized();
  }
  const float again = Similarity(described, vlad.Describe(ToDescriptors(place)));
  EXPECT_GT(again, 0.6F);
  for (uint64_t seed = 10; seed < 40; ++seed) {
    const Eigen::VectorXf other = vlad.Describe(ToDescriptors(RandomPlace(seed)));
    EXPECT_LT(Similarity(described, other), again - 0.2F) << seed;
  }
}

TEST(GlobalDescriptor, ForgetsTheOrder) {
  const GlobalDescriptor vlad = Vocabulary();
  std::vector<Eigen::VectorXf> place = RandomPlace(3);
  const Eigen::VectorXf described = vlad.Describe(ToDescriptors(place));
  std::reverse(place.begin(), place.end());
  EXPECT_TRUE(vlad.Describe(ToDescriptors(place)).isApprox(described, 1e-4F));
}

TEST(GlobalDescriptor, IsZeroWithoutFeatures) {
  const Eigen::VectorXf nothing = Vocabulary().Describe({});
  EXPECT_EQ(nothing.size(), kDimension * kCells);
  EXPECT_TRUE(nothing.isZero(0.0F));
  EXPECT_EQ(Similarity(nothing, nothing), 0.0F);
}

TEST(GlobalDescriptor, RefusesWhatTheVocabularyDoesNotDescribe) {
  const GlobalDescriptor vlad = Vocabulary();
  Random random(1);
  EXPECT_THROW(vlad.Describe(ToDescriptors({RandomUnit(&random, 128)})), CheckError);
  Descriptors binary;
  binary.type = DescriptorType::kBinary;
  binary.bits.assign(kBinaryBytes, 1);
  EXPECT_THROW(vlad.Describe(binary), CheckError);
  EXPECT_THROW(GlobalDescriptor{Eigen::MatrixXf()}, CheckError);
  EXPECT_THROW(GlobalDescriptor(Eigen::MatrixXf::Ones(4, 2)), CheckError);
  EXPECT_THROW(Similarity(Eigen::VectorXf::Zero(3), Eigen::VectorXf::Zero(4)), CheckError);
}

}  // namespace
}  // namespace regolith
