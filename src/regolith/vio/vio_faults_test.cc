// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What visual–inertial odometry does when a sensor fails: it says so, survives, and returns.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "regolith/core/random.h"
#include "regolith/vio/test_world_internal.h"

namespace regolith {
namespace {

constexpr uint64_t kSeed = 11;

/// Hand-held, from 2 s on, for 20 s.
class VioFaults : public ::testing::Test {
 protected:
  TestMotion motion_ = HandHeldMotion(2.0);
  TestSensors sensors_;
  TestRecording recording_ = Record(motion_, RoomLandmarks(kSeed), sensors_, 20.0, kSeed);

  TestRun Run(const VioOptions& options = {}) const {
    return {options, TestRig(sensors_), recording_, motion_};
  }

  /// Whatever happened before, the last five seconds are as good as ever.
  static void ExpectRecovered(const TestRun& run) {
    EXPECT_TRUE(run.IsFinite());
    EXPECT_EQ(run.estimates().back().health, VioHealth::kGood);
    EXPECT_LT(run.ErrorGrowth(15.0, 19.8), 0.05);
  }
};

template <typename Change>
void ChangeFrames(double from, double to, TestRecording* recording, const Change& change) {
  for (VioFrame& frame : recording->frames) {
    const double time = ToSeconds(frame.stamp);
    if (time > from && time < to) change(&frame);
  }
}

Eigen::Vector3d RandomBearing(Random* random) {
  const double x = random->Uniform(-0.8, 0.8);
  return Eigen::Vector3d(x, random->Uniform(-0.6, 0.6), 1.0).normalized();
}

TEST_F(VioFaults, WithoutFaultsItIsGood) {
  const TestRun run = Run();
  ExpectRecovered(run);
  EXPECT_LT(run.LargestError(), 0.05);
  EXPECT_TRUE(run.odometry().Notices().empty());
}

TEST_F(VioFaults, FiveSecondsWithoutImages) {
  auto& frames = recording_.frames;
  frames.erase(std::remove_if(frames.begin(), frames.end(),
                              [](const VioFrame& frame) {
                                const double time = ToSeconds(frame.stamp);
                                return time > 8.0 && time < 13.0;
                              }),
               frames.end());
  const TestRun run = Run();
  EXPECT_TRUE(run.HasHealth(VioHealth::kFewFeatures, 8.5, 13.0));
  // The IMU alone, its biases known to about 0.01 m/s²: ½ 0.01 · 5².
  EXPECT_LT(run.LargestError(), 0.3);
  ExpectRecovered(run);
}

TEST_F(VioFaults, TenBlackFrames) {
  ChangeFrames(8.0, 9.05, &recording_, [](VioFrame* frame) { frame->features.clear(); });
  const TestRun run = Run();
  EXPECT_TRUE(run.HasHealth(VioHealth::kFewFeatures, 8.0, 9.1));
  EXPECT_FALSE(run.HasHealth(VioHealth::kFewFeatures, 9.5, 20.0));
  EXPECT_EQ(run.odometry().resets(), 0U);
  EXPECT_LT(run.LargestError(), 0.1);
  ExpectRecovered(run);
}

TEST_F(VioFaults, ThirtyPercentOfTheBearingsWrong) {
  Random random(kSeed, "wrong");
  ChangeFrames(3.0, 20.0, &recording_, [&](VioFrame* frame) {
    for (TrackedFeature& feature : frame->features) {
      if (random.Uniform() < 0.3) feature.bearing = RandomBearing(&random);
    }
  });
  const TestRun run = Run();
  int outliers = 0;
  for (const VioEstimate& estimate : run.estimates()) outliers += estimate.outliers;
  EXPECT_GT(outliers, 1000);
  EXPECT_LT(run.LargestError(), 0.1);
  ExpectRecovered(run);
}

TEST_F(VioFaults, ThirtyPercentOfTheTracksWrongForEver) {
  // They move with the camera, as its own shadow does.
  Random random(kSeed, "wrong");
  std::map<int64_t, Eigen::Vector3d> stuck;
  ChangeFrames(0.0, 20.0, &recording_, [&](VioFrame* frame) {
    for (TrackedFeature& feature : frame->features) {
      if (Scramble(static_cast<uint64_t>(feature.id)) % 10 >= 3) continue;
      const auto entry = stuck.try_emplace(feature.id, feature.bearing).first;
      const Eigen::Vector3d noise(random.Gaussian(), random.Gaussian(), random.Gaussian());
      feature.bearing = (entry->second + sensors_.pixel_sigma / kTestFocal * noise).normalized();
    }
  });
  const TestRun run = Run();
  EXPECT_LT(run.LargestError(), 0.15);
  ExpectRecovered(run);
}

TEST_F(VioFaults, AGapInTheImu) {
  auto& imu = recording_.imu;
  imu.erase(std::remove_if(imu.begin(), imu.end(),
                           [](const ImuSample& sample) {
                             const double time = ToSeconds(sample.time);
                             return time > 8.02 && time < 8.52;
                           }),
            imu.end());
  const TestRun run = Run();
  EXPECT_TRUE(run.HasNotice("1 gaps in the IMU, the longest 0.5"));
  // Half a metre is what the motion may do meanwhile; images should make it less.
  EXPECT_LT(run.LargestError(), 0.5);
  ExpectRecovered(run);
}

TEST_F(VioFaults, ASaturatedImu) {
  double largest = 0.0;
  for (ImuSample& sample : recording_.imu) {
    const double time = ToSeconds(sample.time);
    if (time < 6.0 || time > 12.0) continue;
    for (double& rate : sample.angular_velocity) {
      largest = std::max(largest, std::abs(rate));
      rate = std::clamp(rate, -0.6, 0.6);
    }
  }
  ASSERT_GT(largest, 0.8);
  const TestRun run = Run();
  EXPECT_TRUE(run.HasNotice("at the end of its range"));
  EXPECT_LT(run.LargestError(), 0.3);
  ExpectRecovered(run);
}

TEST_F(VioFaults, AGyroThatIsFarOffStartsItAnewWhereItWas) {
  for (ImuSample& sample : recording_.imu) {
    const double time = ToSeconds(sample.time);
    if (time > 8.0 && time < 10.0) sample.angular_velocity.y() += 0.6;
  }
  const TestRun run = Run();
  EXPECT_GE(run.odometry().resets(), 1U);
  EXPECT_TRUE(run.HasNotice("started anew"));
  EXPECT_TRUE(run.HasHealth(VioHealth::kDiverged, 8.0, 10.5));
  // 2 s of a gyro 0.6 rad/s off turn gravity by some 30°, which is 5 m/s² and in the end 10 m/s; no
  // new start may add to that.
  for (size_t i = 1; i < run.estimates().size(); ++i) {
    const VioEstimate& before = run.estimates()[i - 1];
    const VioEstimate& now = run.estimates()[i];
    const double error = run.PositionError(now) - run.PositionError(before);
    ASSERT_LT(std::abs(error), 0.8) << "at " << ToSeconds(now.state.time);
  }
  ExpectRecovered(run);
}

}  // namespace
}  // namespace regolith
