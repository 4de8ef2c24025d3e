// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/stereo_odometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regolith/stereo/test_stereo_world_internal.h"

namespace regolith {
namespace {

constexpr double kPeriod = 0.1;  // s

TimeNs TimeOf(size_t image) { return FromSeconds(kPeriod * static_cast<double>(image)); }

/// Straight on at 0.5 m/s, with a slow weave.
SE3 Drive(size_t image) {
  const double x = 0.05 * static_cast<double>(image);
  return TestCameraPose(x, 0.3 * std::sin(0.4 * x), 0.12 * std::cos(0.4 * x) - 0.12);
}

double Error(const SE3& estimate, const SE3& truth) {
  return (estimate.translation - truth.translation).norm();
}

TEST(StereoOdometry, FollowsADriveWithinHalfAPerCent) {
  const TestStereoWorld world(1, -1.0, 30.0, 8.0);
  StereoOdometry odometry(StereoOptions(), kTestCamera, Drive(0));
  StereoEstimate estimate;
  constexpr size_t kImages = 120;
  for (size_t i = 0; i < kImages; ++i) {
    estimate = odometry.Process(TimeOf(i), world.See(Drive(i), i));
    ASSERT_EQ(estimate.health, StereoHealth::kGood) << "image " << i;
  }
  const double length = 0.05 * kImages;
  EXPECT_LT(Error(*estimate.T_world_camera, Drive(kImages - 1)), 0.005 * length);
  EXPECT_LT(Error(odometry.Refined(kImages - 1), Drive(kImages - 1)), 0.005 * length);
  EXPECT_GT(odometry.keyframes_made(), 5U);
  EXPECT_LT(odometry.keyframes_made(), kImages / 2);
  EXPECT_EQ(odometry.losses(), 0U);
}

TEST(StereoOdometry, IsTheSameEveryTime) {
  const TestStereoWorld world(2, -1.0, 15.0, 6.0);
  StereoOdometry one(StereoOptions(), kTestCamera, Drive(0));
  StereoOdometry other(StereoOptions(), kTestCamera, Drive(0));
  for (size_t i = 0; i < 40; ++i) {
    const auto first = one.Process(TimeOf(i), world.See(Drive(i), i)).T_world_camera;
    const auto second = other.Process(TimeOf(i), world.See(Drive(i), i)).T_world_camera;
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->translation, second->translation);
    EXPECT_EQ(first->rotation.coeffs(), second->rotation.coeffs());
  }
}

TEST(StereoOdometry, DoesNotStartWithoutDistances) {
  const TestStereoWorld world(3, -1.0, 15.0, 6.0);
  StereoOdometry odometry(StereoOptions(), kTestCamera, Drive(0));
  StereoFeatures one_eye = world.See(Drive(0), 0);
  one_eye.right_columns.assign(one_eye.size(), StereoFeatures::kNotSeen);
  const StereoEstimate blind = odometry.Process(TimeOf(0), one_eye);
  EXPECT_EQ(blind.health, StereoHealth::kNotStarted);
  EXPECT_FALSE(blind.T_world_camera);
  EXPECT_EQ(odometry.Process(TimeOf(1), world.See(Drive(1), 1)).health, StereoHealth::kGood);
}

TEST(StereoOdometry, ALossIsSaidAndTheWayFoundAgainWhereTheMapIsKnown) {
  const TestStereoWorld world(4, -1.0, 25.0, 8.0);
  const TestStereoWorld elsewhere(5, -1.0, 25.0, 8.0);
  StereoOdometry odometry(StereoOptions(), kTestCamera, Drive(0));
  size_t image = 0;
  for (; image < 60; ++image) odometry.Process(TimeOf(image), world.See(Drive(image), image));
  // Another ground: nothing of it is known, and nothing is said.
  for (size_t i = 0; i < 10; ++i, ++image) {
    const auto estimate = odometry.Process(TimeOf(image), elsewhere.See(Drive(60 + i), image));
    EXPECT_EQ(estimate.health, StereoHealth::kLost);
    EXPECT_FALSE(estimate.T_world_camera);
  }
  EXPECT_EQ(odometry.losses(), 1U);
  // Back where it was half way.
  const auto found = odometry.Process(TimeOf(image), world.See(Drive(30), image));
  ASSERT_EQ(found.health, StereoHealth::kRelocalised);
  EXPECT_LT(Error(*found.T_world_camera, Drive(30)), 0.05);
  for (size_t i = 0; i < 20; ++i) {
    ++image;
    const auto next = odometry.Process(TimeOf(image), world.See(Drive(31 + i), image));
    ASSERT_EQ(next.health, StereoHealth::kGood);
    EXPECT_LT(Error(*next.T_world_camera, Drive(31 + i)), 0.05);
  }
}

TEST(StereoOdometry, OnKnownGroundTheMapDoesNotGrow) {
  const TestStereoWorld world(6, -8.0, 8.0, 8.0);
  const auto circle = [](size_t image) {
    const double angle = 0.02 * static_cast<double>(image);
    return TestCameraPose(2.0 * std::sin(angle), 2.0 - 2.0 * std::cos(angle), angle);
  };
  StereoOdometry odometry(StereoOptions(), kTestCamera, circle(0));
  size_t keyframes = 0;
  size_t landmarks = 0;
  constexpr size_t kRound = 315;
  for (size_t i = 0; i < 2 * kRound; ++i) {
    const auto estimate = odometry.Process(TimeOf(i), world.See(circle(i), i, 0.3, 400));
    ASSERT_TRUE(estimate.T_world_camera) << "image " << i;
    if (i + 1 == kRound) {
      keyframes = odometry.map().keyframes().size();
      landmarks = odometry.map().landmark_count();
    }
  }
  EXPECT_LT(odometry.map().keyframes().size(), 1.6 * static_cast<double>(keyframes));
  EXPECT_LT(odometry.map().landmark_count(), 1.6 * static_cast<double>(landmarks));
}

TEST(StereoOdometry, SettledKeyframesAreHandedOutOnce) {
  const TestStereoWorld world(7, -1.0, 30.0, 8.0);
  StereoOdometry odometry(StereoOptions(), kTestCamera, Drive(0));
  std::vector<StereoPlace> places;
  for (size_t i = 0; i < 150; ++i) {
    odometry.Process(TimeOf(i), world.See(Drive(i), i));
    for (StereoPlace& place : odometry.TakePlaces(false)) places.push_back(std::move(place));
  }
  for (StereoPlace& place : odometry.TakePlaces(true)) places.push_back(std::move(place));
  ASSERT_GT(places.size(), 3U);
  EXPECT_TRUE(odometry.TakePlaces(true).empty());
  for (size_t i = 0; i < places.size(); ++i) {
    if (i > 0) {
      EXPECT_GT(places[i].stamp, places[i - 1].stamp);
    }
    EXPECT_GT(places[i].global.size(), 0);
    EXPECT_EQ(places[i].bearings.size(), places[i].descriptors.size());
    EXPECT_EQ(places[i].ranges.size(), places[i].descriptors.size());
  }
}

}  // namespace
}  // namespace regolith
