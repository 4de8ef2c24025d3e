// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/visual_places.h"

#include <gtest/gtest.h>

#include "regolith/core/random.h"
#include "regolith/features/global_descriptor.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr int kDimension = 32;
constexpr int kFeatures = 80;

Eigen::VectorXf Unit(Random* random) {
  Eigen::VectorXf vector(kDimension);
  for (int i = 0; i < kDimension; ++i) vector[i] = static_cast<float>(random->Gaussian());
  return vector.normalized();
}

/// Points (m) of one place with descriptors of their own.
struct Place {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::VectorXf> descriptors;

  explicit Place(uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < kFeatures; ++i) {
      points.emplace_back(random.Uniform(-4, 4), random.Uniform(-1, 1.5), random.Uniform(5, 15));
      descriptors.push_back(Unit(&random));
    }
  }
};

Eigen::MatrixXf Vocabulary() {
  Random random(99);
  Eigen::MatrixXf centroids(kDimension, 8);
  for (int i = 0; i < 8; ++i) centroids.col(i) = Unit(&random);
  return centroids;
}

// The camera looks along the body's x axis.
SE3 Mounting() {
  Eigen::Matrix3d R_body_camera;
  R_body_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {Eigen::Quaterniond(R_body_camera), {0.4, 0.1, 0.9}};
}

/// A view of a place from a camera; descriptors have noise, and a third of the features are new.
PlaceView See(const Place& place, const SE3& T_place_camera, uint64_t seed) {
  Random random(seed);
  PlaceView view;
  view.T_body_camera = Mounting();
  view.descriptors.type = DescriptorType::kFloat;
  view.descriptors.dimension = kDimension;
  const SE3 T_camera_place = T_place_camera.Inverse();
  for (int i = 0; i < kFeatures; ++i) {
    const auto index = static_cast<size_t>(i);
    Eigen::Vector3d point = T_camera_place * place.points[index];
    Eigen::VectorXf descriptor = (place.descriptors[index] + 0.3F * Unit(&random)).normalized();
    if (i % 3 == 0) {
      descriptor = Unit(&random);
      point = {random.Uniform(-4, 4), random.Uniform(-1, 1), random.Uniform(5, 15)};
    }
    view.ranges.push_back(i % 5 == 0 ? 0.0 : point.norm());
    view.bearings.push_back(
        (point.normalized() + 1e-3 * Eigen::Vector3d(random.Gaussian(), random.Gaussian(), 0.0))
            .normalized());
    view.descriptors.values.insert(view.descriptors.values.end(), descriptor.data(),
                                   descriptor.data() + kDimension);
  }
  view.global = GlobalDescriptor(Vocabulary()).Describe(view.descriptors);
  return view;
}

TEST(VisualPlaces, FindsThePlaceAndTheWayThere) {
  VisualPlaces places{VisualPlacesOptions()};
  for (size_t i = 0; i < 20; ++i) places.Add(i, See(Place(i), SE3(), 100 + i));
  const SE3 T_old_new_camera(ExpSo3({0.02, 0.1, -0.03}), {0.6, -0.1, 0.8});
  places.Add(40, See(Place(7), T_old_new_camera, 200));
  const std::vector<LoopCandidate> candidates = places.Propose(20);
  ASSERT_EQ(candidates.size(), 1U);
  EXPECT_EQ(candidates[0].old_keyframe, 7U);
  const SE3 expected = Mounting() * T_old_new_camera * Mounting().Inverse();
  const Vector6d error = LogSe3(expected.Inverse() * candidates[0].guess.T_target_query);
  EXPECT_LT(error.head<3>().norm(), 0.02);
  EXPECT_LT(error.tail<3>().norm(), 0.1);
  // Young keyframes are not asked.
  EXPECT_TRUE(places.Propose(7).empty());
}

TEST(VisualPlaces, AnotherPlaceMakesNoCandidate) {
  VisualPlacesOptions options;
  VisualPlaces places(options);
  for (size_t i = 0; i < 20; ++i) places.Add(i, See(Place(i), SE3(), 100 + i));
  places.Add(40, See(Place(50), SE3(), 200));
  EXPECT_TRUE(places.Propose(20).empty());
}

TEST(VisualPlaces, WhatBothDirectionsSayIsConfirmed) {
  VisualPlaces places{VisualPlacesOptions()};
  for (size_t i = 0; i < 20; ++i) places.Add(i, See(Place(i), SE3(), 100 + i));
  const SE3 T_old_new_camera(ExpSo3({0.02, 0.1, -0.03}), {0.6, -0.1, 0.8});
  places.Add(40, See(Place(7), T_old_new_camera, 200));
  const std::vector<LoopMeasurement> loops = places.Confirmed(20);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_EQ(loops[0].old_keyframe, 7U);
  EXPECT_EQ(loops[0].new_keyframe, 40U);
  const SE3 expected = Mounting() * T_old_new_camera * Mounting().Inverse();
  const Vector6d error = LogSe3(expected.Inverse() * loops[0].T_old_new.T_a_b);
  EXPECT_LT(error.head<3>().norm(), 0.01);
  EXPECT_LT(error.tail<3>().norm(), 0.05);
  EXPECT_TRUE(places.Confirmed(7).empty());
}

TEST(VisualPlaces, DirectionsThatDisagreeConfirmNothing) {
  VisualPlaces places{VisualPlacesOptions()};
  PlaceView old_view = See(Place(7), SE3(), 107);
  // The old distances are wrong: the way there would be another than the way back.
  for (double& range : old_view.ranges) range *= 1.5;
  places.Add(0, std::move(old_view));
  places.Add(40, See(Place(7), SE3(ExpSo3({0.02, 0.1, -0.03}), {0.6, -0.1, 0.8}), 200));
  EXPECT_EQ(places.Propose(20).size(), 1U);
  EXPECT_TRUE(places.Confirmed(20).empty());
}

}  // namespace
}  // namespace regolith
