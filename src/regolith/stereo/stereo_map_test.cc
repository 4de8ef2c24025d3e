// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/stereo_map.h"

#include <gtest/gtest.h>

#include "regolith/stereo/local_adjustment.h"
#include "regolith/stereo/test_stereo_world_internal.h"

namespace regolith {
namespace {

/// Keyframes along a line that see the same points without noise; feature i is point i.
class StereoMapTest : public testing::Test {
 protected:
  void SetUp() override {
    Random random(3);
    for (int i = 0; i < 60; ++i) {
      points_.emplace_back(random.Uniform(3, 8), random.Uniform(-1.5, 1.5),
                           random.Uniform(-0.1, 0.3));
    }
    for (int i = 0; i < 4; ++i) AddKeyframe(TestCameraPose(0.3 * i, 0.0, 0.02 * i));
    for (size_t i = 0; i < points_.size(); ++i) {
      landmarks_.push_back(map_.AddLandmark(points_[i], 0, i));
      for (KeyframeId keyframe = 1; keyframe < 4; ++keyframe) {
        EXPECT_TRUE(map_.AddSighting(landmarks_[i], keyframe, i));
      }
      map_.Refresh(landmarks_[i]);
    }
  }

  void AddKeyframe(const SE3& T_world_camera) {
    StereoKeyframe keyframe;
    keyframe.T_world_camera = T_world_camera;
    keyframe.parent = static_cast<KeyframeId>(map_.keyframes().size()) - 1;
    keyframe.features.descriptors.type = DescriptorType::kBinary;
    for (size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d pixel = kTestCamera.Project(T_world_camera.Inverse() * points_[i]);
      keyframe.features.pixels.push_back(pixel.head<2>().cast<float>());
      keyframe.features.right_columns.push_back(static_cast<float>(pixel.z()));
      keyframe.features.scales.push_back(1.0F);
      for (int byte = 0; byte < kBinaryBytes; ++byte) {
        keyframe.features.descriptors.bits.push_back(static_cast<uint8_t>(i));
      }
    }
    keyframe.landmarks.assign(points_.size(), kNoId);
    map_.AddKeyframe(keyframe);
  }

  std::vector<Eigen::Vector3d> points_;
  std::vector<LandmarkId> landmarks_;
  StereoMap map_{kTestCamera};
};

TEST_F(StereoMapTest, KnowsWhoSeesTheSame) {
  const std::vector<Covisible> seeing = map_.CovisibleWith(1);
  ASSERT_EQ(seeing.size(), 3U);
  EXPECT_EQ(seeing[0].keyframe, 3);  // of equal ones the newest
  EXPECT_EQ(seeing[0].shared, 60);
}

TEST_F(StereoMapTest, ARemovedKeyframeKeepsItsPlaceFromItsParent) {
  const SE3 before = map_.Pose(2);
  map_.RemoveKeyframe(2);
  EXPECT_FALSE(map_.HasKeyframe(2));
  EXPECT_LT((map_.Pose(2).translation - before.translation).norm(), 1e-12);
  map_.keyframe(1).T_world_camera.translation.z() += 1.0;
  EXPECT_NEAR(map_.Pose(2).translation.z(), before.translation.z() + 1.0, 1e-12);
  EXPECT_EQ(map_.Find(landmarks_[0])->sightings.size(), 3U);
}

TEST_F(StereoMapTest, ALandmarkWithoutSightingsIsGone) {
  for (KeyframeId keyframe = 0; keyframe < 4; ++keyframe) {
    map_.RemoveSighting(landmarks_[5], keyframe);
  }
  EXPECT_EQ(map_.Find(landmarks_[5]), nullptr);
  EXPECT_EQ(map_.keyframe(2).landmarks[5], kNoId);
}

TEST_F(StereoMapTest, MergedLandmarksHaveTheSightingsOfBoth) {
  map_.RemoveSighting(landmarks_[7], 3);
  const LandmarkId twin = map_.AddLandmark(points_[7], 3, 7);
  map_.Merge(landmarks_[7], twin);
  EXPECT_EQ(map_.Find(twin), nullptr);
  EXPECT_EQ(map_.Find(landmarks_[7])->sightings.size(), 4U);
  EXPECT_EQ(map_.keyframe(3).landmarks[7], landmarks_[7]);
}

TEST_F(StereoMapTest, ASlimKeyframeHoldsWhatItsLandmarksNeed) {
  map_.RemoveLandmark(landmarks_[0]);
  map_.Slim(1);
  const StereoKeyframe& slim = map_.keyframe(1);
  EXPECT_EQ(slim.features.size(), 59U);
  EXPECT_EQ(slim.features.descriptors.size(), 59U);
  EXPECT_EQ(slim.landmarks[0], landmarks_[1]);
  for (const StereoSighting& sighting : map_.Find(landmarks_[1])->sightings) {
    EXPECT_EQ(map_.keyframe(sighting.keyframe).landmarks[static_cast<size_t>(sighting.feature)],
              landmarks_[1]);
  }
}

TEST_F(StereoMapTest, AdjustmentBringsKeyframesAndLandmarksIntoAgreement) {
  Random random(9);
  const auto error = [&] {
    double sum = 0.0;
    for (KeyframeId keyframe = 1; keyframe < 4; ++keyframe) {
      const SE3 truth = TestCameraPose(0.3 * static_cast<double>(keyframe), 0.0,
                                       0.02 * static_cast<double>(keyframe));
      sum += (map_.Pose(keyframe).translation - truth.translation).norm();
    }
    return sum;
  };
  for (KeyframeId keyframe = 1; keyframe < 4; ++keyframe) {
    map_.keyframe(keyframe).T_world_camera.translation +=
        Eigen::Vector3d(random.Uniform(-0.04, 0.04), random.Uniform(-0.04, 0.04), 0.02);
  }
  for (const LandmarkId landmark : landmarks_) {
    map_.Find(landmark)->position_world += Eigen::Vector3d(random.Uniform(-0.1, 0.1), 0.0, 0.02);
  }
  // One sighting is wrong by 20 pixels.
  map_.keyframe(2).features.pixels[9].y() += 20.0F;
  ASSERT_GT(error(), 0.05);
  LocalAdjustmentOptions options;
  options.iterations = 20;
  AdjustAround(3, options, SightingNoise(), &map_);
  EXPECT_LT(error(), 0.005);
  EXPECT_EQ(map_.keyframe(2).landmarks[9], kNoId);
  EXPECT_EQ(map_.keyframe(2).landmarks[10], landmarks_[10]);
}

}  // namespace
}  // namespace regolith
