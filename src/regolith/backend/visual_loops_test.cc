// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/visual_loops.h"

#include <gtest/gtest.h>

#include "regolith/backend/test_drive_internal.h"

namespace regolith {
namespace {

/// Stones on a ground, each with a descriptor of its own, and the camera that sees them.
class Stones {
 public:
  explicit Stones(const TestGround& ground) {
    Random random(77);
    for (int i = 0; i < 6000; ++i) {
      const double x = random.Uniform(-20, 20);
      const double y = random.Uniform(-20, 20);
      points_world_.emplace_back(x, y, ground.Height(x, y) + random.Uniform(0.0, 0.2));
    }
  }

  /// As an image's features would be: bearings with noise, a few bits flipped, and no distance of
  /// one in four.
  PlaceView See(const SE3& T_world_body, uint64_t image) const {
    PlaceView view;
    view.T_body_camera = Mounting();
    view.descriptors.type = DescriptorType::kBinary;
    Random random(image);
    const SE3 T_camera_world = (T_world_body * Mounting()).Inverse();
    for (size_t i = 0; i < points_world_.size(); ++i) {
      const Eigen::Vector3d point = T_camera_world * points_world_[i];
      if (point.z() < 0.5 || point.norm() > 9.0 || std::abs(point.x()) > 0.84 * point.z()) continue;
      const Eigen::Vector3d noise(random.Gaussian(0.0, 1e-3), random.Gaussian(0.0, 1e-3), 0.0);
      view.bearings.push_back((point.normalized() + noise).normalized());
      view.ranges.push_back(i % 4 == 0 ? 0.0 : point.norm() + random.Gaussian(0.0, 0.03));
      for (uint64_t byte = 0; byte < kBinaryBytes; ++byte) {
        // Stones of a kind are alike, so that there is something for a vocabulary to find.
        const uint64_t of_kind = Scramble(i % 16 * 100 + byte);
        const uint64_t own = Scramble(i * 7919 + byte) & Scramble(i + byte + 5);
        const uint64_t noise_bits = random.Next() & random.Next() & random.Next() & random.Next();
        view.descriptors.bits.push_back(static_cast<uint8_t>(of_kind ^ own ^ noise_bits));
      }
    }
    return view;
  }

 private:
  /// The camera looks along the body's x axis, 15° down.
  static SE3 Mounting() {
    Eigen::Matrix3d R_level_camera;
    R_level_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    return {ExpSo3({0.0, 0.26, 0.0}) * Eigen::Quaterniond(R_level_camera), {0.4, 0.0, -0.1}};
  }

  std::vector<Eigen::Vector3d> points_world_;
};

/// Lost for a while between two laps: 40 m and 0.6 rad off, and it knows that it may be.
Odometry Lost() {
  Odometry odometry;
  odometry.jump = {ExpSo3({0.0, 0.0, 0.6}), {32.0, -24.0, 0.3}};
  odometry.jump_rotation_sigma = 0.4;
  odometry.jump_position_sigma = 25.0;
  return odometry;
}

constexpr size_t kLap = 34;  // keyframes

/// Loops of the second lap with the first.
size_t Count(const Backend& backend, LoopSource source, bool accepted) {
  size_t count = 0;
  for (const LoopRecord& loop : backend.loops()) {
    if (loop.old_keyframe >= kLap || loop.new_keyframe < kLap) continue;
    const bool is_accepted = loop.verdict.outcome == LoopOutcome::kAccepted;
    if (loop.source == source && is_accepted == accepted) ++count;
  }
  return count;
}

class VisualLoopsTest : public testing::Test {
 protected:
  /// A lap, and another by an odometry that got lost in between. `seen`: where the camera is when
  /// the rover is at a place of the second lap.
  void DriveTwoLaps(const std::function<SE3(const Moment&)>& seen) {
    const auto look_at = [&](const SE3& T_world_camera_body) {
      if (visual_) {
        visual_->Add(stones_.See(T_world_camera_body, ++images_), &driver_.backend());
      }
    };
    driver_.Drive(Laps(ground_, 1), Odometry(),
                  [&](const Moment& moment) { look_at(moment.T_world_body); });
    std::vector<Moment> again;
    for (const SE3& pose : OvalLap(ground_, 0.3, false)) again.push_back({pose, &ground_});
    driver_.Drive(again, Lost(), [&](const Moment& moment) { look_at(seen(moment)); });
  }

  const TestGround ground_{MoonGround(), 1};
  const Stones stones_{ground_};
  Driver driver_;
  std::optional<VisualLoops> visual_{std::in_place, VisualPlacesOptions()};
  uint64_t images_ = 0;
};

SE3 AsItIs(const Moment& moment) { return moment.T_world_body; }

TEST_F(VisualLoopsTest, FindTheWayBackWhereThePositionSearchCannot) {
  DriveTwoLaps(AsItIs);
  EXPECT_GT(driver_.Error(driver_.odometry()), 20.0);
  EXPECT_LT(driver_.Error(driver_.corrected()), 0.3);
  EXPECT_GE(Count(driver_.backend(), LoopSource::kImages, true), 3U);
  // Once the way is known, the others are found without them.
  EXPECT_GE(Count(driver_.backend(), LoopSource::kPosition, true), 15U);
}

TEST_F(VisualLoopsTest, WithoutThemTheRoverStaysLost) {
  visual_.reset();
  DriveTwoLaps(AsItIs);
  EXPECT_EQ(Count(driver_.backend(), LoopSource::kPosition, true), 0U);
  EXPECT_GT(driver_.Error(driver_.corrected()), 20.0);
}

// All images of the second lap are of the other side of the oval: hundreds of features agree, and
// all proposals agree with one another.
TEST_F(VisualLoopsTest, WhatLooksTheSameIsRefusedWhereTheGroundIsAnother) {
  const std::vector<SE3> other_side = OvalLap(ground_, 0.3, false);
  size_t place = other_side.size() / 2;
  DriveTwoLaps([&](const Moment&) { return other_side[place++ % other_side.size()]; });
  EXPECT_EQ(Count(driver_.backend(), LoopSource::kImages, true), 0U);
  EXPECT_GE(Count(driver_.backend(), LoopSource::kImages, false), 25U);
  EXPECT_EQ(Count(driver_.backend(), LoopSource::kPosition, true), 0U);
}

TEST_F(VisualLoopsTest, AreNotTriedWhereThePositionSearchHasFoundOne) {
  const auto look = [&](const Moment& moment) {
    const size_t before = driver_.backend().loops().size();
    const bool has_loop = driver_.backend().HasLoopAtNewest();
    visual_->Add(stones_.See(moment.T_world_body, ++images_), &driver_.backend());
    if (has_loop) {
      EXPECT_EQ(driver_.backend().loops().size(), before);
    }
  };
  driver_.Drive(Laps(ground_, 1), Odometry(), look);
  driver_.Drive(Laps(ground_, 1), Odometry(), look);
  EXPECT_GE(Count(driver_.backend(), LoopSource::kPosition, true), 15U);
}

TEST_F(VisualLoopsTest, ADarkImageProposesNothing) {
  PlaceView dark;
  dark.descriptors.type = DescriptorType::kBinary;
  driver_.Drive(Laps(ground_, 1), Odometry(),
                [&](const Moment&) { visual_->Add(dark, &driver_.backend()); });
  for (const LoopRecord& loop : driver_.backend().loops()) {
    EXPECT_EQ(loop.source, LoopSource::kPosition);
  }
}

}  // namespace
}  // namespace regolith
