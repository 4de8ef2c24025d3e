// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/sliding_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "regolith/factors/gravity_tilt.h"
#include "regolith/factors/normal_equations.h"
#include "regolith/geometry/so3.h"
#include "regolith/imu/propagation.h"
#include "regolith/vio/test_world_internal.h"
#include "regolith/vio/window_solver.h"

namespace regolith {
namespace {

constexpr double kBegin = 4.0;  // s, on the first straight

std::vector<FeatureObservation> Observations(const VioFrame& frame) {
  std::vector<FeatureObservation> observations;
  for (const TrackedFeature& feature : frame.features) {
    FeatureObservation observation;
    observation.id = feature.id;
    observation.bearing = feature.bearing;
    observations.push_back(std::move(observation));
  }
  return observations;
}

/// A window on the rover's drive on the Moon, a keyframe every half second. Its first velocity is a
/// little wrong.
class WindowOnADrive : public ::testing::Test {
 protected:
  void SetUp() override {
    sensors_.gravity = 1.62;
    calibration_.gravity = sensors_.gravity;
    calibration_.noise = sensors_.noise;
    calibration_.focal = kTestFocal;
    calibration_.T_imu_camera = sensors_.T_imu_camera;
    recording_ = Record(RoverMotion(), GroundLandmarks(4), sensors_, 25.0, 4);
    window_ = std::make_unique<SlidingWindow>(options_, calibration_);
  }

  void Start(const StartUncertainty& sigma) {
    const TrueMotion truth = TrueMotionAt(RoverMotion(), kBegin);
    NavState state;
    state.time = FromSeconds(kBegin);
    state.T_world_imu = truth.T_world_imu;
    state.v_world_imu = truth.v_world_imu + Eigen::Vector3d(0.03, -0.02, 0.01);
    state.gyro_bias = recording_.gyro_bias;
    window_->Start(state, Eigen::Vector2d::Zero(), sigma, state.time);
    next_ = static_cast<size_t>(std::lround(kBegin / 0.1)) - 1;
    window_->Observe(Observations(recording_.frames[next_++]));
  }

  /// Where the drive began, and which way it went, is not known.
  void StartAnywhere() {
    StartUncertainty sigma;
    sigma.rotation = 1e3;
    sigma.position = 1e3;
    sigma.velocity = 1e3;
    Start(sigma);
  }

  void StartAsKnown() {
    StartUncertainty sigma;
    sigma.velocity = 0.05;
    Start(sigma);
  }

  /// The next frame; `is_keyframe` as told, so that the window is marginalised.
  void Step(bool is_keyframe) {
    const VioFrame& frame = recording_.frames[next_++];
    FrameMotion motion;
    motion.samples = SamplesBetween(recording_.imu, window_->newest().time, frame.stamp);
    window_->Append(frame.stamp, frame.stamp, std::move(motion), {});
    window_->Observe(Observations(frame));
    SolveWindow(window_.get(), is_keyframe ? 6 : 3);
    window_->RemoveOutliers();
    if (is_keyframe) window_->MakeKeyframe();
  }

  void Drive(int keyframes) {
    for (int i = 0; i < 5 * keyframes; ++i) Step(i % 5 == 4);
  }

  /// The whole window's equations, landmarks eliminated, at these points.
  NormalEquations Equations(std::vector<LinearisedBlock> points) {
    NormalEquations equations(std::move(points));
    const auto add = [&](const WindowResidual& residual) {
      equations.Add(*residual.factor, residual.loss.get(), residual.blocks);
    };
    add(*window_->PriorResidual());
    for (const auto& frame : window_->frames()) {
      for (const WindowResidual& residual : frame->residuals) add(residual);
    }
    for (auto& [id, landmark] : window_->landmarks()) {
      if (!landmark.in_use || landmark.sightings.size() < 2) continue;
      equations.BeginLandmark(&landmark.inverse_distance);
      for (const LandmarkSighting& sighting : landmark.sightings) {
        for (const WindowResidual& residual : sighting.residuals) add(residual);
      }
      equations.EndLandmark();
    }
    return equations;
  }

  std::vector<std::pair<double*, int>> Blocks() {
    std::vector<std::pair<double*, int>> blocks = window_->SharedBlocks();
    for (const auto& frame : window_->frames()) {
      blocks.emplace_back(frame->pose.data(), kPoseBlockSize);
      blocks.emplace_back(frame->motion.data(), kMotionBlockSize);
    }
    return blocks;
  }

  VioOptions options_;
  TestSensors sensors_;
  VioCalibration calibration_;
  TestRecording recording_;
  std::unique_ptr<SlidingWindow> window_;
  size_t next_ = 0;
};

/// How the blocks change when the whole world is turned about gravity (by 1 rad) or moved along an
/// axis (by 1 m): what neither images nor an IMU see.
Eigen::VectorXd TurnAll(const std::vector<LinearisedBlock>& blocks, double gravity) {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  int size = 0;
  for (const LinearisedBlock& block : blocks) {
    size += block.tangent_size();
    if (block.size() == kTiltBlockSize) axis = -GravityFromTilt(block.point, gravity).normalized();
  }
  Eigen::VectorXd change = Eigen::VectorXd::Zero(size);
  int column = 0;
  for (const LinearisedBlock& block : blocks) {
    if (block.size() == kPoseBlockSize) {
      const SE3 pose = FromPoseBlock(block.point.data());
      change.segment<3>(column) = pose.rotation.conjugate() * axis;
      change.segment<3>(column + 3) = axis.cross(pose.translation);
    } else if (block.size() == kMotionBlockSize) {
      change.segment<3>(column) = axis.cross(block.point.head<3>());
    }
    column += block.tangent_size();
  }
  return change;
}

Eigen::VectorXd MoveAll(const std::vector<LinearisedBlock>& blocks, int axis) {
  int size = 0;
  for (const LinearisedBlock& block : blocks) size += block.tangent_size();
  Eigen::VectorXd change = Eigen::VectorXd::Zero(size);
  int column = 0;
  for (const LinearisedBlock& block : blocks) {
    if (block.size() == kPoseBlockSize) change[column + 3 + axis] = 1.0;
    column += block.tangent_size();
  }
  return change;
}

/// Of all these blocks only the first pose.
Eigen::VectorXd OfFirstPose(const std::vector<LinearisedBlock>& blocks, Eigen::VectorXd change) {
  int column = 0;
  bool is_first = true;
  for (const LinearisedBlock& block : blocks) {
    const bool keep = is_first && block.size() == kPoseBlockSize;
    if (!keep) change.segment(column, block.tangent_size()).setZero();
    is_first = is_first && !keep;
    column += block.tangent_size();
  }
  return change;
}

double Information(const Eigen::MatrixXd& information, const Eigen::VectorXd& change) {
  return change.dot(information * change);
}

TEST_F(WindowOnADrive, ThePriorGainsNothingOfWhatCannotBeObserved) {
  // Through the turn on the spot and on: some thirty frames are marginalised.
  StartAnywhere();
  Drive(40);
  const LinearPrior& prior = window_->prior();
  const Eigen::MatrixXd information = prior.jacobian.transpose() * prior.jacobian;
  const Eigen::VectorXd turn = TurnAll(prior.blocks, sensors_.gravity);
  const double of_one = Information(information, OfFirstPose(prior.blocks, turn));
  EXPECT_GT(of_one, 1e4);
  EXPECT_LT(std::abs(Information(information, turn)), 1e-6 * of_one);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd move = MoveAll(prior.blocks, axis);
    const double one = Information(information, OfFirstPose(prior.blocks, move));
    EXPECT_GT(one, 1e2);
    EXPECT_LT(std::abs(Information(information, move)), 1e-6 * one) << "axis " << axis;
  }
  // The states have moved since the prior was linearised, else this would show nothing.
  double moved = 0.0;
  for (const LinearisedBlock& block : prior.blocks) {
    moved = std::max(moved, block.Minus(block.block).norm());
  }
  EXPECT_GT(moved, 1e-3);
}

TEST_F(WindowOnADrive, KeptLinearisationPointsAreWhatPreventsIt) {
  StartAnywhere();
  Drive(25);
  const auto kept = WithPriorPoints(Blocks(), window_->prior());
  const auto current = WithPriorPoints(Blocks(), LinearPrior());
  const Eigen::VectorXd turn_kept = TurnAll(kept, sensors_.gravity);
  const Eigen::VectorXd turn_current = TurnAll(current, sensors_.gravity);
  const double with_kept = std::abs(Information(Equations(kept).information(), turn_kept));
  const double with_current = Information(Equations(current).information(), turn_current);
  EXPECT_GT(with_current, 1e3 * with_kept);
}

TEST_F(WindowOnADrive, StaysBoundedAndRemembersEveryFrame) {
  StartAsKnown();
  Drive(30);
  EXPECT_EQ(window_->frames().size(), static_cast<size_t>(options_.keyframes));
  EXPECT_LT(window_->landmarks().size(), 600U);
  const FrameHistory history = window_->History();
  ASSERT_EQ(history.size(), 151U);
  const SE3 T_true_world =
      TrueMotionAt(RoverMotion(), kBegin).T_world_imu * history.Pose(0).Inverse();
  for (size_t i = 0; i < history.size(); ++i) {
    EXPECT_EQ(history.Time(i), recording_.frames[39 + i].stamp);
    const SE3 truth = TrueMotionAt(RoverMotion(), ToSeconds(history.Time(i))).T_world_imu;
    const SE3 pose = T_true_world * history.Pose(i);
    ASSERT_LT((pose.translation - truth.translation).norm(), 0.15) << "frame " << i;
    ASSERT_LT(AngleBetween(pose.rotation, truth.rotation), 0.03) << "frame " << i;
  }
}

TEST_F(WindowOnADrive, LeavesOutASightingThatDoesNotFitAndKeepsTheOthers) {
  StartAsKnown();
  Drive(8);
  Landmark* wrong = nullptr;
  for (auto& [id, landmark] : window_->landmarks()) {
    if (landmark.in_use && landmark.sightings.size() >= 5) wrong = &landmark;
  }
  ASSERT_NE(wrong, nullptr);
  const size_t sightings = wrong->sightings.size();
  // 10 pixels beside where it is.
  const int64_t id = std::find_if(window_->landmarks().begin(), window_->landmarks().end(),
                                  [&](const auto& entry) { return &entry.second == wrong; })
                         ->first;
  VioFrame& frame = recording_.frames[next_];
  const auto feature = std::find_if(frame.features.begin(), frame.features.end(),
                                    [&](const auto& other) { return other.id == id; });
  ASSERT_NE(feature, frame.features.end());
  feature->bearing = ExpSo3({10.0 / kTestFocal, 0.0, 0.0}) * feature->bearing;
  Step(true);
  EXPECT_FALSE(wrong->IsSeenIn(&window_->newest()));
  EXPECT_GE(wrong->sightings.size(), sightings - 1);
  EXPECT_GT(window_->LandmarksInNewest(), 40);
}

}  // namespace
}  // namespace regolith
