// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Whether the covariance that visual–inertial odometry gives is that of its errors.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include <Eigen/Cholesky>

#include "regolith/vio/test_world_internal.h"

namespace regolith {
namespace {

constexpr double kDimension = 6.0;

/// With the noise that the sensors have.
VioOptions ExactOptions(const TestSensors& sensors) {
  VioOptions options;
  options.pixel_sigma = sensors.pixel_sigma;
  options.noise_inflation = 1.0;
  return options;
}

/// Normalised estimation error squared of the pose at the last keyframe, the first pose known.
double PoseError(uint64_t seed, double duration, bool zero_velocity) {
  const TestMotion motion = HandHeldMotion(2.0);
  const TestSensors sensors;
  const TestRecording recording = Record(motion, RoomLandmarks(seed), sensors, duration, seed);
  VioOptions options = ExactOptions(sensors);
  options.zero_velocity = zero_velocity;
  const TestRun run(options, TestRig(sensors), recording, motion);
  // The covariance is as of the last keyframe.
  const VioEstimate* last = &run.estimates().front();
  for (const VioEstimate& estimate : run.estimates()) {
    if (estimate.is_keyframe) last = &estimate;
  }
  const Vector6d error = Minus(run.TruePose(*last), last->state.T_world_imu);
  const Matrix6d covariance = last->covariance.topLeftCorner<6, 6>();
  return error.dot(covariance.ldlt().solve(error));
}

double MeanPoseError(int seeds, double duration, bool zero_velocity) {
  double sum = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    sum += PoseError(static_cast<uint64_t>(seed), duration, zero_velocity);
  }
  return sum / seeds;
}

TEST(VioConsistency, TheCovarianceIsOfTheSizeOfTheErrors) {
  constexpr int kSeeds = 5;
  const double mean = MeanPoseError(kSeeds, 6.0, false);
  // 99.9 % of chi-square values of 30 degrees of freedom lie between these.
  EXPECT_LT(mean, 59.7 / kSeeds);
  EXPECT_GT(mean, 11.6 / kSeeds);
}

class VioConsistencyLong : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("REGOLITH_LONG_TESTS") == nullptr) {
      GTEST_SKIP() << "a long test: scripts/test.sh --long";
    }
  }
  static constexpr int kSeeds = 50;
};

TEST_F(VioConsistencyLong, TheCovarianceIsThatOfTheErrors) {
  const double mean = MeanPoseError(kSeeds, 10.0, false);
  RecordProperty("mean_nees", std::to_string(mean));
  const double sigma = std::sqrt(2.0 * kDimension / kSeeds);
  EXPECT_LT(mean, kDimension + 3.0 * sigma);
  EXPECT_GT(mean, kDimension - 3.0 * sigma);
}

/// When a motion begins, rest is seen for a moment more: half a pixel between images is some cm/s,
/// and rest_velocity_sigma says 5 mm/s. Errors are larger than the covariance by a third.
TEST_F(VioConsistencyLong, RestMakesItALittleTooSure) {
  const double mean = MeanPoseError(kSeeds, 10.0, true);
  RecordProperty("mean_nees", std::to_string(mean));
  EXPECT_LT(mean, 2.0 * kDimension);
  EXPECT_GT(mean, 0.5 * kDimension);
}

}  // namespace
}  // namespace regolith
