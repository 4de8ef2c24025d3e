// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "regolith/core/stopwatch.h"
#include "regolith/features/feature_frontend.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/wheel_odometry.h"
#include "regolith/vio/imu_quality.h"
#include "regolith/vio/motion_initialization.h"
#include "regolith/vio/sliding_window.h"
#include "regolith/vio/vio_options.h"

namespace regolith {

/// How visual–inertial odometry does.
enum class VioHealth {
  kGood,
  kFewFeatures,  ///< the IMU (and the wheels) carry on alone
  kLargeBias,    ///< a new start: a bias is out of its range
  kDiverged,     ///< a new start: sightings do not fit, or the solver failed
  kJump,         ///< a new start: corrections that no rover makes
};
const char* VioHealthName(VioHealth health);

/// One image as odometry takes it.
struct VioFrame {
  TimeNs stamp = 0;
  std::vector<TrackedFeature> features;                        ///< sorted by id
  std::vector<std::optional<Eigen::Vector3d>> right_bearings;  ///< one a feature, or empty
};

/// What odometry says of one image.
struct VioEstimate {
  TimeNs stamp = 0;                          ///< the image's own
  NavState state;                            ///< at its time on the IMU's clock
  Matrix15d covariance = Matrix15d::Zero();  ///< as of the last keyframe, grown by nothing since
  VioHealth health = VioHealth::kGood;
  bool at_rest = false;
  bool is_keyframe = false;
  int landmarks = 0;
  int outliers = 0;
  int measured_distances = 0;  ///< of its landmarks, by a lidar, at a keyframe
  double visual_cost = 0.0;
  double slip = 0.0;
  double time_offset = 0.0;  ///< s
  size_t frame = 0;          ///< its number in the window's history
  bool has_image = true;     ///< false: a state in a time without images
  std::vector<StageTime> stages;
};

/// A pose at a time that was asked for.
struct StampedState {
  TimeNs time = 0;
  NavState state;    ///< as known then
  size_t frame = 0;  ///< number in the window's history of the last image before, that it goes with
  SE3 T_frame_imu;   ///< from that image's pose
};

/// Visual–inertial odometry by a sliding window: images, an IMU, and wheels where asked for.
/// Measurements come in order of their stamps; an image is worked off as soon as the IMU has
/// reached it. The world is level, with its origin at the first IMU pose.
class VisualInertialOdometry {
 public:
  /// The rig has an IMU and the camera. `right_camera`: its name in the rig, or empty.
  VisualInertialOdometry(const VioOptions& options, const RigCalibration& rig,
                         const std::string& camera, const std::string& right_camera);

  /// Where distances come from, beside the images; it outlives this.
  void SetDistanceSource(DistanceSource* source) { distance_source_ = source; }

  /// Waits so long (s) for SetStart before it starts from its own measurements.
  void ExpectStart(double seconds) { expect_start_ = seconds; }
  /// What another odometry knows (its world becomes this one's): the next start is made from it.
  void SetStart(const NavState& state, const Eigen::Vector3d& gravity_world) {
    start_ = {state, gravity_world};
  }

  std::vector<VioEstimate> AddImu(const ImuSample& sample);
  void AddWheels(const WheelOdometry& odometry);
  std::vector<VioEstimate> AddFrame(VioFrame frame);
  /// Asks for the state at a time (IMU's clock), such as a scan's. Times in their order.
  void AddStamp(TimeNs time) { stamps_.push_back(time); }
  /// The states asked for that have become known since the last call.
  std::vector<StampedState> TakeStamped() { return std::exchange(stamped_, {}); }

  /// Works off what still waits for measurements that never came.
  std::vector<VioEstimate> Finish();

  bool is_running() const { return window_.is_running(); }
  Eigen::Vector3d gyro_bias() const { return window_.newest().motion.segment<3>(3); }
  /// The state at a time that the IMU has reached, propagated from the last image. Nothing before
  /// the first state.
  std::optional<NavState> StateAt(TimeNs time) const;
  /// Number in the history of the last image, while running.
  size_t last_frame() const { return window_.frames_so_far() - 1; }
  size_t resets() const { return resets_; }
  size_t keyframes() const { return keyframes_; }
  const SlidingWindow& window() const { return window_; }
  std::vector<std::string> Notices() const;

 private:
  std::vector<VioEstimate> ProcessReady(bool all);
  bool HasReached(TimeNs time) const;
  void StopAtGap();
  void AnswerStamps(TimeNs until);
  void TryToStart(bool all);
  void Begin(const NavState& state, const Eigen::Vector2d& tilt, const StartUncertainty& sigma);
  bool IsImuSlow();
  bool StartFromState();
  bool StartAtRest();
  bool StartInMotion();
  bool FeaturesStand(const VioFrame& first, const VioFrame& second) const;
  VioEstimate Process(const VioFrame& frame);
  VioEstimate Report(const VioFrame& frame) const;
  FrameMotion MotionTo(TimeNs time, const VioFrame& frame) const;
  bool StandsStill(TimeNs time, const VioFrame& frame) const;
  bool WheelsStand(TimeNs since) const;
  std::vector<FeatureObservation> Observations(const VioFrame& frame) const;
  bool IsKeyframe() const;
  int Iterations(bool is_keyframe) const;
  void Judge(const NavState& predicted, VioEstimate* estimate);
  void Restart(const NavState& state);
  std::optional<NavState> RecentMotion() const;
  void FollowRecentMotion(const NavState& recent, NavState* state) const;
  std::vector<BearingFrame> BearingFrames(const std::deque<VioFrame>& frames) const;
  void Forget();
  TimeNs TimeOf(const VioFrame& frame) const;

  VioOptions options_;
  VioCalibration calibration_;
  double accelerometer_bias_sigma_;
  std::string imu_topic_;
  SlidingWindow window_;
  DistanceSource* distance_source_ = nullptr;
  double expect_start_ = 0.0;
  std::optional<std::pair<NavState, Eigen::Vector3d>> start_;  ///< and gravity
  std::deque<VioFrame> waiting_;
  std::vector<ImuSample> samples_;
  ImuQuality quality_;
  std::vector<WheelOdometry> wheels_;
  std::deque<TimeNs> stamps_;
  std::vector<StampedState> stamped_;
  std::optional<VioFrame> last_frame_;
  std::deque<VioFrame> recent_;  ///< the last ones, as many as a start in motion takes
  Matrix15d covariance_ = Matrix15d::Zero();
  size_t unexplained_images_ = 0;  ///< before a start in motion
  size_t resets_ = 0;
  size_t keyframes_ = 0;
  int bad_frames_ = 0;  ///< more than good ones
  std::string start_notice_;
  std::map<std::string, size_t> failures_;
};

}  // namespace regolith
