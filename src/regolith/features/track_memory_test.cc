// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/track_memory.h"

#include <gtest/gtest.h>

#include "regolith/core/random.h"

namespace regolith {
namespace {

Descriptors RandomBits(uint64_t seed, size_t count) {
  Descriptors descriptors;
  descriptors.type = DescriptorType::kBinary;
  Random random(seed);
  for (size_t i = 0; i < count * kBinaryBytes; ++i) {
    descriptors.bits.push_back(static_cast<uint8_t>(random.Next()));
  }
  return descriptors;
}

TrackedFeature Feature(int64_t id, float x, float y, int age = 3) {
  TrackedFeature feature;
  feature.id = id;
  feature.pixel = {x, y};
  feature.age = age;
  return feature;
}

FlowField Flow(const Eigen::Vector2f& everywhere) {
  FlowField flow;
  flow.Estimate(KeypointGrid(640, 480, 80), std::vector<Eigen::Vector2f>{{100, 100}},
                std::vector<Eigen::Vector2f>{everywhere});
  return flow;
}

TEST(FlowField, IsTheMedianAroundAndFallsBackOnTheMedianOfAll) {
  std::vector<Eigen::Vector2f> pixels;
  std::vector<Eigen::Vector2f> flows;
  for (int i = 0; i < 20; ++i) {
    pixels.emplace_back(40.0F + static_cast<float>(i), 40.0F);
    flows.emplace_back(i == 3 ? 500.0F : 5.0F, -1.0F);
  }
  for (int i = 0; i < 30; ++i) {
    pixels.emplace_back(600.0F, 10.0F * static_cast<float>(i));
    flows.emplace_back(0.0F, 2.0F);
  }
  FlowField flow;
  EXPECT_EQ(flow.At({3, 3}), Eigen::Vector2f(0, 0));
  flow.Estimate(KeypointGrid(640, 480, 80), pixels, flows);
  EXPECT_EQ(flow.At({30, 30}), Eigen::Vector2f(5, -1));
  EXPECT_EQ(flow.At({620, 100}), Eigen::Vector2f(0, 2));
  EXPECT_EQ(flow.At({300, 470}), Eigen::Vector2f(0, 2));
  EXPECT_EQ(flow.At({-5000, 40}), Eigen::Vector2f(5, -1));
  flow.Estimate(KeypointGrid(640, 480, 80), {}, {});
  EXPECT_EQ(flow.At({30, 30}), Eigen::Vector2f(0, 0));
}

TEST(TrackMemory, FindsATrackWhereTheFlowHasTakenIt) {
  const Descriptors descriptors = RandomBits(1, 3);
  TrackMemoryOptions options;
  options.search_radius = 10.0;
  TrackMemory memory(options, DescriptorMatcherOptions(), 100);
  for (size_t i = 0; i < 3; ++i) {
    memory.Add(Feature(static_cast<int64_t>(10 + i), 100.0F * static_cast<float>(i + 1), 50.0F),
               descriptors, i);
  }
  const TrackGeometry geometry(nullptr);
  for (int i = 0; i < 4; ++i) memory.Advance(geometry, std::nullopt, Flow({20.0F, 0.0F}));
  std::vector<RecoveredTrack> recovered;
  // Row 0 of the keypoints is track 12; row 1 looks as track 10 but lies where that was lost.
  Descriptors keypoints;
  keypoints.ResetLike(descriptors);
  keypoints.Append(descriptors, 2);
  keypoints.Append(descriptors, 0);
  memory.Recover({std::vector<Eigen::Vector2f>{{385.0F, 52.0F}, {100.0F, 50.0F}}}, keypoints,
                 &recovered);
  ASSERT_EQ(recovered.size(), 1U);
  EXPECT_EQ(recovered[0].feature.id, 12);
  EXPECT_EQ(recovered[0].keypoint, 0);
  EXPECT_EQ(memory.tracks().size(), 2U);
}

TEST(TrackMemory, ForgetsTheOldAndKeepsTheLongestWithinItsCapacity) {
  const Descriptors descriptors = RandomBits(2, 6);
  TrackMemoryOptions options;
  options.frames = 3;
  TrackMemory memory(options, DescriptorMatcherOptions(), 4);
  for (size_t i = 0; i < 6; ++i) {
    memory.Add(Feature(static_cast<int64_t>(i), 10.0F, 10.0F, i == 2 ? 1 : static_cast<int>(9 - i)),
               descriptors, i);
  }
  memory.Trim();
  ASSERT_EQ(memory.tracks().size(), 4U);
  std::vector<int64_t> ids;
  for (const LostTrack& track : memory.tracks()) ids.push_back(track.feature.id);
  EXPECT_EQ(ids, (std::vector<int64_t>{0, 1, 3, 4}));
  const TrackGeometry geometry(nullptr);
  for (int i = 0; i < 3; ++i) memory.Advance(geometry, std::nullopt, Flow({0.0F, 0.0F}));
  EXPECT_EQ(memory.tracks().size(), 4U);
  memory.Advance(geometry, std::nullopt, Flow({0.0F, 0.0F}));
  EXPECT_EQ(memory.tracks().size(), 0U);
}

}  // namespace
}  // namespace regolith
