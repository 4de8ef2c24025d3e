// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/factors/linear_prior_factor.h"
#include "regolith/sensor/imu_noise.h"
#include "regolith/sensor/wheel_odometry.h"
#include "regolith/vio/frame_history.h"
#include "regolith/vio/lidar_depth.h"
#include "regolith/vio/vio_options.h"
#include "regolith/vio/window_frame.h"

namespace regolith {

/// What a visual–inertial window has to know of its rover.
struct VioCalibration {
  double gravity = 9.81;  ///< m/s²
  ImuNoise noise;
  double focal = 400.0;  ///< pixels, mean of both axes
  SE3 T_imu_camera;
  std::optional<SE3> T_imu_right;  ///< the right camera of a stereo pair
  std::optional<SE3> T_imu_base;   ///< of the wheels
  /// s, of what is to be added to the camera's stamps; 0: nothing, exactly.
  double time_offset_sigma = 0.0;
};

/// How well a first state is known, 1 σ.
struct StartUncertainty {
  double rotation = 1e-4;            ///< rad; the first pose defines the world
  double position = 1e-4;            ///< m
  double velocity = 0.005;           ///< m/s
  double gyro_bias = 1e-3;           ///< rad/s
  double accelerometer_bias = 0.05;  ///< m/s²
  double tilt = 0.05;                ///< rad, of gravity's direction in the world
};

/// What a feature was in an image, as the window takes it.
struct FeatureObservation {
  int64_t id = 0;
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();      ///< unit, camera frame
  Eigen::Vector3d bearing_rate = Eigen::Vector3d::Zero();  ///< 1/s
  std::optional<Eigen::Vector3d> right_bearing;            ///< unit, right camera
};

/// The states of the last keyframes and of the newest frame, the landmarks that they see, and what
/// is left of older ones: a prior. Keeps the books; WindowSolver solves it.
class SlidingWindow {
 public:
  SlidingWindow(const VioOptions& options, const VioCalibration& calibration);
  SlidingWindow(const SlidingWindow&) = delete;
  SlidingWindow& operator=(const SlidingWindow&) = delete;

  /// Forgets everything but the history; Start begins anew.
  void Stop();
  /// The first frame, a keyframe; everything before is forgotten. `tilt`: direction of gravity.
  void Start(const NavState& state, const Eigen::Vector2d& tilt, const StartUncertainty& sigma,
             TimeNs stamp);
  bool is_running() const { return !frames_.empty(); }

  /// A new newest frame, its state predicted. The newest so far is given up unless it is a
  /// keyframe. `motion`: since the newest so far, without the wheels' way; `wheels`: odometry that
  /// covers the time since the last keyframe.
  void Append(TimeNs stamp, TimeNs time, FrameMotion motion, Span<const WheelOdometry> wheels);

  /// What the newest frame sees.
  void Observe(const std::vector<FeatureObservation>& features);

  /// Asks for the distances of landmarks that the newest frame sees and that have none measured
  /// yet; the number of those that now have one.
  int MeasureDistances(DistanceSource* source);

  /// Says that the newest frame is a keyframe; the oldest leaves the window where it is full.
  void MakeKeyframe();

  /// Median angle (rad, turning taken off) by which features moved since the last keyframe before
  /// the newest frame, and the share of that one's features that are still seen.
  struct Progress {
    double parallax = 0.0;
    double shared = 0.0;
    double turn = 0.0;  ///< rad
  };
  Progress ProgressSinceKeyframe() const;

  /// Leaves sightings out that do not fit; their number.
  int RemoveOutliers();
  /// Gives a distance to landmarks that lack one, and says which are used.
  void PrepareLandmarks();

  const std::deque<std::unique_ptr<WindowFrame>>& frames() const { return frames_; }
  WindowFrame& newest() { return *frames_.back(); }
  const WindowFrame& newest() const { return *frames_.back(); }
  std::map<int64_t, Landmark>& landmarks() { return landmarks_; }
  const std::map<int64_t, Landmark>& landmarks() const { return landmarks_; }
  int LandmarksInNewest() const;

  /// All frames so far, those of the window with their states of now.
  FrameHistory History() const;
  size_t frames_so_far() const { return history_.size(); }

  Eigen::Vector3d gravity_world() const;
  SE3 T_imu_camera() const { return FromPoseBlock(T_imu_camera_.data()); }
  double time_offset() const { return time_offset_; }
  const Eigen::Vector2d& tilt() const { return tilt_; }

  /// Blocks that belong to no frame and are estimated, with their sizes.
  std::vector<std::pair<double*, int>> SharedBlocks();
  /// Those that are not estimated.
  std::vector<std::pair<double*, int>> FixedBlocks();
  bool uses_slip() const { return calibration_.T_imu_base && options_.wheels; }
  std::optional<WindowResidual> PriorResidual() const;
  const LinearPrior& prior() const { return prior_; }

  /// Covariance of [pose, motion] of the newest frame: rotation, position, velocity, biases.
  Matrix15d NewestCovariance();

 private:
  void SetPriorFactor();
  void BuildMotionResiduals(WindowFrame* before, WindowFrame* frame);
  void AddWheelResiduals(WindowFrame* before, WindowFrame* frame);
  void AddRestResiduals(WindowFrame* before, WindowFrame* frame);
  void Preintegrate(const WindowFrame& before, WindowFrame* frame) const;
  void BuildSightingResiduals(Landmark* landmark, size_t index);
  void BuildAnchorResiduals(Landmark* landmark);
  void PlaceLandmark(Landmark* landmark);
  void ForgetFrame(const WindowFrame* frame);
  void Reanchor(Landmark* landmark);
  void MarginaliseOldest();
  bool refines_time_offset() const {
    return options_.refine_time_offset && calibration_.time_offset_sigma > 0.0;
  }
  double BearingSigma() const { return options_.pixel_sigma / calibration_.focal; }

  VioOptions options_;
  VioCalibration calibration_;
  FrameHistory history_;
  std::deque<std::unique_ptr<WindowFrame>> frames_;
  std::map<int64_t, Landmark> landmarks_;
  LinearPrior prior_;
  std::shared_ptr<const ceres::CostFunction> prior_factor_;
  std::vector<double*> prior_blocks_;
  std::shared_ptr<const ceres::LossFunction> visual_loss_;
  std::shared_ptr<const ceres::LossFunction> wheel_loss_;

  Eigen::Vector2d tilt_ = Eigen::Vector2d::Zero();
  PoseBlock T_imu_camera_;
  PoseBlock T_imu_right_;
  double time_offset_ = 0.0;
};

}  // namespace regolith
