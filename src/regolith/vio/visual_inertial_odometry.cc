// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/visual_inertial_odometry.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/error.h"
#include "regolith/core/median.h"
#include "regolith/factors/gravity_tilt.h"
#include "regolith/geometry/so3.h"
#include "regolith/imu/propagation.h"
#include "regolith/imu/rest_detection.h"
#include "regolith/vio/motion_initialization.h"
#include "regolith/vio/window_solver.h"

namespace regolith {
namespace {

/// Without images a state is made this often, so that wheels count and motion stays short.
constexpr double kBlindInterval = 1.0;        // s
constexpr double kLongestBlindTime = 1.0;     // s without an IMU
constexpr double kKeyframeInterval = 3.0;     // s, of motion between keyframes at most
constexpr double kFeaturelessInterval = 0.5;  // s, between keyframes that see little
constexpr double kWheelsLate = 0.1;           // s, that an image waits for wheels
constexpr double kBackwards = 0.12;           // s, that a state is continued into the past
constexpr double kShortestMotion = 0.002;     // s
constexpr double kStillWheels = 0.005;        // m, over a window of rest
constexpr double kFreshStart = 0.5;           // s, age of such a state that a new start still takes
constexpr double kKnownVelocity = 0.02;       // m/s, of a state that another odometry gives
constexpr double kKnownGyroBias = 1e-3;       // rad/s
constexpr int kBadFrames = 5;                 // more than good ones: a new start
constexpr double kDivergedCost = 25.0;        // variances a sighting
constexpr double kMovingGyroBias = 0.02;      // rad/s, of a start in motion
constexpr double kJumpFloor = 0.1;            // m

VioCalibration CalibrationOf(const VioOptions& options, const RigCalibration& rig,
                             const std::string& camera, const std::string& right_camera) {
  VioCalibration calibration;
  calibration.gravity = rig.gravity;
  calibration.noise = rig.imu->noise;
  const CameraCalibration& left = rig.cameras.at(camera);
  calibration.focal = left.intrinsics.focal.mean();
  calibration.T_imu_camera = left.T_imu_camera;
  calibration.time_offset_sigma = left.time_offset_sigma;
  if (!right_camera.empty()) calibration.T_imu_right = rig.cameras.at(right_camera).T_imu_camera;
  if (options.wheels && rig.wheels) calibration.T_imu_base = rig.wheels->T_imu_base;
  return calibration;
}

double MedianAngle(const VioFrame& first, const VioFrame& second, size_t* shared) {
  std::vector<double> angles;
  size_t j = 0;
  for (const TrackedFeature& feature : first.features) {
    while (j < second.features.size() && second.features[j].id < feature.id) ++j;
    if (j == second.features.size()) break;
    if (second.features[j].id != feature.id) continue;
    angles.push_back(AngleBetween(feature.bearing, second.features[j].bearing));
  }
  *shared = angles.size();
  return Median(std::move(angles));
}

}  // namespace

const char* VioHealthName(VioHealth health) {
  switch (health) {
    case VioHealth::kGood:
      return "good";
    case VioHealth::kFewFeatures:
      return "few features";
    case VioHealth::kLargeBias:
      return "large bias";
    case VioHealth::kDiverged:
      return "diverged";
    case VioHealth::kJump:
      return "jump";
  }
  return "";
}

VisualInertialOdometry::VisualInertialOdometry(const VioOptions& options, const RigCalibration& rig,
                                               const std::string& camera,
                                               const std::string& right_camera)
    : options_(options),
      calibration_(CalibrationOf(options, rig, camera, right_camera)),
      accelerometer_bias_sigma_(rig.imu->noise.accelerometer_bias_sigma),
      imu_topic_(rig.imu->topic),
      window_(options, calibration_),
      quality_(options.max_imu_gap, rig.gravity) {
  options.Check();
}

std::vector<VioEstimate> VisualInertialOdometry::AddImu(const ImuSample& sample) {
  if (!samples_.empty() && sample.time <= samples_.back().time) return {};
  quality_.Add(sample);
  const bool is_helped = expect_start_ > 0.0;
  if (is_helped && is_running() &&
      SecondsBetween(samples_.back().time, sample.time) > kLongestBlindTime) {
    StopAtGap();
  }
  samples_.push_back(sample);
  std::vector<VioEstimate> estimates = ProcessReady(false);
  if (is_running() && waiting_.empty() &&
      SecondsBetween(window_.newest().time, sample.time) > kBlindInterval) {
    VioFrame blind;
    blind.stamp = AddSeconds(sample.time, -window_.time_offset());
    estimates.push_back(Process(blind));
    estimates.back().has_image = false;
  }
  return estimates;
}

/// What images alone would make of a long time without an IMU is worse than what another odometry
/// knows at its end: the next start is made from that.
void VisualInertialOdometry::StopAtGap() {
  ++resets_;
  ++failures_["long IMU gap"];
  window_.Stop();
  samples_.clear();
  start_.reset();
  last_frame_.reset();
  recent_.clear();
  bad_frames_ = 0;
}

void VisualInertialOdometry::AddWheels(const WheelOdometry& odometry) {
  if (!calibration_.T_imu_base) return;
  if (!wheels_.empty() && odometry.time <= wheels_.back().time) return;
  wheels_.push_back(odometry);
}

std::vector<VioEstimate> VisualInertialOdometry::AddFrame(VioFrame frame) {
  waiting_.push_back(std::move(frame));
  return ProcessReady(false);
}

std::vector<VioEstimate> VisualInertialOdometry::Finish() { return ProcessReady(true); }

TimeNs VisualInertialOdometry::TimeOf(const VioFrame& frame) const {
  return AddSeconds(frame.stamp, window_.time_offset());
}

std::vector<VioEstimate> VisualInertialOdometry::ProcessReady(bool all) {
  std::vector<VioEstimate> estimates;
  if (samples_.empty()) return estimates;
  if (!is_running()) {
    TryToStart(all);
    if (!is_running()) return estimates;
    estimates.push_back(Report(waiting_.front()));
    waiting_.pop_front();
  }
  while (!waiting_.empty() && (all || HasReached(TimeOf(waiting_.front())))) {
    const VioFrame frame = std::move(waiting_.front());
    waiting_.pop_front();
    AnswerStamps(TimeOf(frame));
    if (SecondsBetween(window_.newest().time, TimeOf(frame)) < kShortestMotion) continue;
    estimates.push_back(Process(frame));
  }
  AnswerStamps(samples_.back().time);
  return estimates;
}

/// Wheels count while they come.
bool VisualInertialOdometry::HasReached(TimeNs time) const {
  if (time > samples_.back().time) return false;
  return wheels_.empty() || wheels_.back().time >= time ||
         SecondsBetween(time, samples_.back().time) > kWheelsLate;
}

void VisualInertialOdometry::AnswerStamps(TimeNs until) {
  for (; !stamps_.empty() && stamps_.front() <= until; stamps_.pop_front()) {
    const TimeNs time = stamps_.front();
    // Before the first image nothing is known; a scan that began a moment earlier is not refused.
    if (SecondsBetween(time, window_.newest().time) > kBackwards) continue;
    const NavState state = *StateAt(time);
    const SE3 T_world_frame = FromPoseBlock(window_.newest().pose.data());
    stamped_.push_back({time, state, last_frame(), T_world_frame.Inverse() * state.T_world_imu});
  }
}

void VisualInertialOdometry::TryToStart(bool all) {
  while (!waiting_.empty() && TimeOf(waiting_.front()) < samples_.front().time) {
    waiting_.pop_front();
  }
  if (waiting_.empty() || IsImuSlow() || StartFromState()) return;
  const TimeNs first = TimeOf(waiting_.front());
  const double seconds = SecondsBetween(first, samples_.back().time);
  if (seconds < std::max(options_.initialization_window, expect_start_) && !all) return;
  if (StartAtRest()) return;
  if (SecondsBetween(first, TimeOf(waiting_.back())) < options_.moving_window && !all) return;
  if (StartInMotion()) return;
  // Not yet: perhaps the next images tell more.
  waiting_.pop_front();
  ++unexplained_images_;
}

/// Of what has come so far, from its first half second on.
bool VisualInertialOdometry::IsImuSlow() {
  const double seconds = SecondsBetween(samples_.front().time, samples_.back().time);
  if (seconds < options_.rest_window) return false;
  const double rate = static_cast<double>(samples_.size() - 1) / seconds;
  if (rate >= options_.min_imu_rate) return false;
  waiting_.clear();
  start_notice_ = Concatenate("the IMU comes at ", rate, " Hz, below ", options_.min_imu_rate,
                              " Hz: visual–inertial odometry does not start");
  return true;
}

/// The window begins at the first image that waits.
void VisualInertialOdometry::Begin(const NavState& state, const Eigen::Vector2d& tilt,
                                   const StartUncertainty& sigma) {
  const VioFrame& frame = waiting_.front();
  start_notice_.clear();
  window_.Start(state, tilt, sigma, frame.stamp);
  window_.Observe(Observations(frame));
  last_frame_ = frame;
}

bool VisualInertialOdometry::FeaturesStand(const VioFrame& first, const VioFrame& second) const {
  size_t shared = 0;
  const double angle = MedianAngle(first, second, &shared);
  return static_cast<int>(shared) < options_.min_features ||
         angle * calibration_.focal < options_.rest_pixels;
}

/// At the first image after the state that is known, since another odometry is ahead of images.
bool VisualInertialOdometry::StartFromState() {
  if (!start_ || start_->first.time < samples_.front().time) return false;
  const auto& [known, gravity_world] = *start_;
  const auto frame = std::find_if(waiting_.begin(), waiting_.end(), [&](const VioFrame& waiting) {
    return TimeOf(waiting) > start_->first.time;
  });
  if (frame == waiting_.end() || TimeOf(*frame) > samples_.back().time) return false;
  waiting_.erase(waiting_.begin(), frame);
  StartUncertainty sigma;
  sigma.velocity = kKnownVelocity;
  sigma.gyro_bias = kKnownGyroBias;
  sigma.accelerometer_bias = accelerometer_bias_sigma_;
  sigma.tilt = accelerometer_bias_sigma_ / calibration_.gravity;
  Begin(PropagateTo(known, samples_, TimeOf(waiting_.front()), gravity_world),
        TiltOfGravity(gravity_world), sigma);
  return true;
}

bool VisualInertialOdometry::StartAtRest() {
  const VioFrame& first = waiting_.front();
  const TimeNs start = TimeOf(first);
  const TimeNs end = AddSeconds(start, options_.initialization_window);
  const std::vector<ImuSample> window = SamplesBetween(samples_, start, end);
  if (window.size() < 2) return false;
  const RestReport report = DetectRest(window, calibration_.gravity, options_.rest);
  const double force = report.statistics.mean_specific_force.norm();
  if (force < 0.5 * calibration_.gravity || force > 2.0 * calibration_.gravity) {
    throw InputError(
        imu_topic_,
        Concatenate("mean specific force at the start is ", force, ", but gravity in the rig is ",
                    calibration_.gravity, " m/s²; check `gravity` in the rig and the IMU's units"));
  }
  if (!report.at_rest) return false;
  const VioFrame* last = &first;
  for (const VioFrame& frame : waiting_) {
    if (TimeOf(frame) <= end) last = &frame;
  }
  if (!FeaturesStand(first, *last)) return false;
  const RestState rest = InitializeAtRest(report.statistics);
  NavState state;
  state.time = start;
  state.T_world_imu.rotation = rest.rotation_world_imu;
  state.gyro_bias = rest.gyro_bias;
  StartUncertainty sigma;
  sigma.velocity = options_.rest_velocity_sigma;
  sigma.gyro_bias = std::max(3.0 * rest.gyro_bias_sigma, 1e-4);
  sigma.accelerometer_bias = accelerometer_bias_sigma_;
  sigma.tilt = accelerometer_bias_sigma_ / calibration_.gravity + 1e-3;
  Begin(state, Eigen::Vector2d::Zero(), sigma);
  return true;
}

std::vector<BearingFrame> VisualInertialOdometry::BearingFrames(
    const std::deque<VioFrame>& frames) const {
  std::vector<BearingFrame> result;
  for (const VioFrame& frame : frames) {
    if (TimeOf(frame) > samples_.back().time) break;
    BearingFrame bearings{TimeOf(frame), {}};
    for (const TrackedFeature& feature : frame.features) {
      bearings.bearings.emplace_back(feature.id, feature.bearing);
    }
    result.push_back(std::move(bearings));
  }
  return result;
}

bool VisualInertialOdometry::StartInMotion() {
  const auto start = InitializeInMotion(BearingFrames(waiting_), samples_,
                                        calibration_.T_imu_camera, calibration_.gravity);
  if (!start) return false;
  StartUncertainty sigma;
  sigma.velocity = options_.moving_velocity_sigma;
  sigma.gyro_bias = kMovingGyroBias;
  sigma.accelerometer_bias = accelerometer_bias_sigma_;
  sigma.tilt = options_.moving_tilt_sigma;
  Begin(start->state, Eigen::Vector2d::Zero(), sigma);
  start_notice_ = Concatenate("started in motion at ", start->state.v_world_imu.norm(),
                              " m/s from ", start->landmarks, " landmarks");
  return true;
}

bool VisualInertialOdometry::StandsStill(TimeNs time, const VioFrame& frame) const {
  if (!options_.zero_velocity) return false;
  const TimeNs begin = AddSeconds(time, -options_.rest_window);
  if (samples_.front().time > begin || quality_.IsDoubtful(begin, time)) return false;
  const std::vector<ImuSample> window = SamplesBetween(samples_, begin, time);
  const RestReport report = DetectRest(window, calibration_.gravity, options_.rest);
  if (!report.at_rest) return false;
  const Eigen::Vector3d gyro_bias = window_.newest().motion.segment<3>(3);
  if ((report.statistics.mean_rate - gyro_bias).norm() > options_.rest_max_rate) return false;
  if (!WheelsStand(begin)) return false;
  return last_frame_ && FeaturesStand(*last_frame_, frame);
}

bool VisualInertialOdometry::WheelsStand(TimeNs since) const {
  return std::none_of(wheels_.begin(), wheels_.end(), [&](const WheelOdometry& odometry) {
    const SE3 step = odometry.T_odom_base.Inverse() * wheels_.back().T_odom_base;
    return odometry.time >= since && step.translation.norm() > kStillWheels;
  });
}

FrameMotion VisualInertialOdometry::MotionTo(TimeNs time, const VioFrame& frame) const {
  FrameMotion motion;
  const TimeNs start = window_.newest().time;
  motion.samples = SamplesBetween(samples_, start, time);
  motion.is_doubtful = quality_.IsDoubtful(start, time);
  motion.at_rest = StandsStill(time, frame);
  return motion;
}

std::vector<FeatureObservation> VisualInertialOdometry::Observations(const VioFrame& frame) const {
  std::vector<FeatureObservation> observations;
  const double seconds = last_frame_ ? SecondsBetween(last_frame_->stamp, frame.stamp) : 0.0;
  size_t j = 0;
  for (size_t i = 0; i < frame.features.size(); ++i) {
    const TrackedFeature& feature = frame.features[i];
    FeatureObservation observation;
    observation.id = feature.id;
    observation.bearing = feature.bearing;
    if (seconds > 0.0) {
      const auto& before = last_frame_->features;
      while (j < before.size() && before[j].id < feature.id) ++j;
      if (j < before.size() && before[j].id == feature.id) {
        observation.bearing_rate = (feature.bearing - before[j].bearing) / seconds;
      }
    }
    if (!frame.right_bearings.empty()) observation.right_bearing = frame.right_bearings[i];
    observations.push_back(std::move(observation));
  }
  return observations;
}

/// Where the IMU did not tell, the first guess is far off.
int VisualInertialOdometry::Iterations(bool is_keyframe) const {
  if (window_.newest().since.is_doubtful) return 3 * options_.keyframe_iterations;
  return is_keyframe ? options_.keyframe_iterations : options_.frame_iterations;
}

bool VisualInertialOdometry::IsKeyframe() const {
  const WindowFrame& newest = window_.newest();
  if (newest.at_rest) return false;
  const WindowFrame& last = *window_.frames()[window_.frames().size() - 2];
  const double seconds = SecondsBetween(last.time, newest.time);
  if (seconds > kKeyframeInterval) return true;
  const SlidingWindow::Progress progress = window_.ProgressSinceKeyframe();
  if (progress.parallax * calibration_.focal > options_.keyframe_parallax) return true;
  if (progress.turn > options_.keyframe_turn) return true;
  return progress.shared < options_.keyframe_shared && seconds > kFeaturelessInterval;
}

VioEstimate VisualInertialOdometry::Report(const VioFrame& frame) const {
  VioEstimate estimate;
  const WindowFrame& newest = window_.newest();
  estimate.stamp = frame.stamp;
  estimate.state = newest.State();
  estimate.covariance = covariance_;
  estimate.health = VioHealth::kGood;
  estimate.at_rest = newest.at_rest;
  estimate.is_keyframe = newest.is_keyframe;
  estimate.landmarks = window_.LandmarksInNewest();
  estimate.slip = newest.slip;
  estimate.time_offset = window_.time_offset();
  estimate.frame = last_frame();
  return estimate;
}

VioEstimate VisualInertialOdometry::Process(const VioFrame& frame) {
  Stopwatch stopwatch;
  const TimeNs time = TimeOf(frame);
  FrameMotion motion = MotionTo(time, frame);
  // What stood still until now says when the motion began, and is kept for that.
  if (window_.newest().at_rest && !motion.at_rest && !window_.newest().is_keyframe) {
    window_.MakeKeyframe();
  }
  window_.Append(frame.stamp, time, std::move(motion), wheels_);
  const NavState predicted = window_.newest().State();
  window_.Observe(Observations(frame));
  const bool is_keyframe = IsKeyframe();
  stopwatch.Lap("vio_prepare");
  int measured = 0;
  if (is_keyframe && distance_source_ != nullptr) {
    measured = window_.MeasureDistances(distance_source_);
    stopwatch.Lap("vio_distances");
  }
  const WindowSolution solution = SolveWindow(&window_, Iterations(is_keyframe));
  const int outliers = window_.RemoveOutliers();
  stopwatch.Lap("vio_solve");
  if (is_keyframe) {
    ++keyframes_;
    covariance_ = window_.NewestCovariance();
    stopwatch.Lap("vio_covariance");
    window_.MakeKeyframe();
    stopwatch.Lap("vio_marginalise");
  }
  VioEstimate estimate = Report(frame);
  estimate.outliers = outliers;
  estimate.measured_distances = measured;
  estimate.visual_cost = solution.visual_cost;
  if (!solution.is_usable) estimate.health = VioHealth::kDiverged;
  recent_.push_back(frame);
  Judge(predicted, &estimate);
  estimate.stages = stopwatch.stages();
  last_frame_ = frame;
  Forget();
  return estimate;
}

void VisualInertialOdometry::Judge(const NavState& predicted, VioEstimate* estimate) {
  const NavState& state = estimate->state;
  const double seconds = std::max(
      SecondsBetween(window_.frames()[window_.frames().size() - 2]->time, state.time), 0.05);
  const double correction =
      (state.T_world_imu.translation - predicted.T_world_imu.translation).norm();
  if (estimate->landmarks < options_.min_features) estimate->health = VioHealth::kFewFeatures;
  // Sightings in plenty of which hardly any fits: the motion is wrong, not the scene. Where the IMU
  // said nothing, that passes.
  const bool is_outside =
      !window_.newest().since.is_doubtful &&
      estimate->outliers > 2 * std::max(estimate->landmarks, options_.min_features);
  if (is_outside || estimate->visual_cost > kDivergedCost) {
    estimate->health = VioHealth::kDiverged;
  }
  if (correction > kJumpFloor + options_.max_jump_speed * seconds) {
    estimate->health = VioHealth::kJump;
  }
  const bool is_finite = state.T_world_imu.translation.allFinite() &&
                         state.v_world_imu.allFinite() && state.gyro_bias.allFinite();
  if (!is_finite || state.gyro_bias.norm() > options_.max_gyro_bias ||
      state.accelerometer_bias.norm() > options_.max_accelerometer_bias) {
    estimate->health = is_finite ? VioHealth::kLargeBias : VioHealth::kDiverged;
    bad_frames_ = kBadFrames;
  }
  // While few features fit, nothing speaks for the motion nor against it.
  if (estimate->health == VioHealth::kGood) {
    bad_frames_ = std::max(bad_frames_ - 1, 0);
  } else if (estimate->health != VioHealth::kFewFeatures) {
    ++bad_frames_;
  }
  if (bad_frames_ < kBadFrames) return;
  ++failures_[VioHealthName(estimate->health)];
  Restart(is_finite ? state : predicted);
}

/// What the last images and the IMU say without what was estimated: attitude (level, heading
/// arbitrary), velocity and gyro bias now.
std::optional<NavState> VisualInertialOdometry::RecentMotion() const {
  const TimeNs now = window_.newest().time;
  std::vector<BearingFrame> frames = BearingFrames(recent_);
  if (frames.empty() || frames.front().time < samples_.front().time) return std::nullopt;
  const auto motion =
      InitializeInMotion(frames, samples_, calibration_.T_imu_camera, calibration_.gravity);
  if (!motion || motion->state.gyro_bias.norm() > options_.max_gyro_bias) return std::nullopt;
  return PropagateTo(motion->state, samples_, now, {0.0, 0.0, -calibration_.gravity});
}

/// Position and heading stay.
void VisualInertialOdometry::FollowRecentMotion(const NavState& recent, NavState* state) const {
  const Eigen::Quaterniond R_world_level =
      RotationBetween(Eigen::Vector3d::UnitZ(), -window_.gravity_world().normalized());
  const Eigen::Matrix3d turned = (R_world_level.conjugate() * state->T_world_imu.rotation *
                                  recent.T_world_imu.rotation.conjugate())
                                     .toRotationMatrix();
  const double heading = std::atan2(turned(1, 0) - turned(0, 1), turned(0, 0) + turned(1, 1));
  const Eigen::Quaterniond R_world_recent = R_world_level * ExpSo3({0.0, 0.0, heading});
  state->T_world_imu.rotation = R_world_recent * recent.T_world_imu.rotation;
  state->v_world_imu = R_world_recent * recent.v_world_imu;
  state->gyro_bias = recent.gyro_bias;
}

/// A new window that begins where the last one ended.
void VisualInertialOdometry::Restart(const NavState& state) {
  ++resets_;
  bad_frames_ = 0;
  NavState start = state;
  if (start.gyro_bias.norm() > options_.max_gyro_bias) start.gyro_bias.setZero();
  if (start.accelerometer_bias.norm() > options_.max_accelerometer_bias) {
    start.accelerometer_bias.setZero();
  }
  StartUncertainty sigma;
  sigma.velocity = options_.moving_velocity_sigma;
  sigma.gyro_bias = 0.01;
  sigma.accelerometer_bias = accelerometer_bias_sigma_;
  sigma.tilt = options_.moving_tilt_sigma;
  Eigen::Vector2d tilt = window_.tilt();
  if (start_ && std::abs(SecondsBetween(start_->first.time, start.time)) < kFreshStart) {
    start.v_world_imu = start_->first.v_world_imu;
    start.gyro_bias = start_->first.gyro_bias;
    start.accelerometer_bias = start_->first.accelerometer_bias;
    tilt = TiltOfGravity(start_->second);
  } else if (const auto recent = RecentMotion()) {
    FollowRecentMotion(*recent, &start);
    sigma.gyro_bias = kMovingGyroBias;
  } else if (start.v_world_imu.norm() > options_.max_jump_speed) {
    start.v_world_imu.setZero();
    sigma.velocity = options_.max_jump_speed;
  }
  window_.Start(start, tilt, sigma, window_.newest().stamp);
  last_frame_.reset();
}

std::optional<NavState> VisualInertialOdometry::StateAt(TimeNs time) const {
  if (!is_running()) return std::nullopt;
  NavState state = window_.newest().State();
  if (time <= state.time) {
    // An image that came a little later has been worked off already.
    const double back = SecondsBetween(state.time, time);
    const auto sample =
        std::lower_bound(samples_.begin(), samples_.end(), time,
                         [](const ImuSample& other, TimeNs limit) { return other.time < limit; });
    const Eigen::Vector3d rate = sample == samples_.end()
                                     ? Eigen::Vector3d::Zero()
                                     : Eigen::Vector3d(sample->angular_velocity - state.gyro_bias);
    state.T_world_imu.rotation = state.T_world_imu.rotation * ExpSo3(back * rate);
    state.T_world_imu.translation += back * state.v_world_imu;
    state.time = time;
    return state;
  }
  return PropagateTo(state, samples_, time, window_.gravity_world());
}

void VisualInertialOdometry::Forget() {
  while (SecondsBetween(recent_.front().stamp, recent_.back().stamp) > options_.moving_window) {
    recent_.pop_front();
  }
  const double span = std::max(2.0 * options_.rest_window, options_.moving_window + 0.1);
  const TimeNs needed = AddSeconds(window_.newest().time, -span);
  const auto first =
      std::lower_bound(samples_.begin(), samples_.end(), needed,
                       [](const ImuSample& sample, TimeNs time) { return sample.time < time; });
  samples_.erase(samples_.begin(), first);
  quality_.Forget(needed);
  // The wheels' way is put together from the last keyframe on.
  TimeNs reach = window_.newest().time;
  for (const auto& frame : window_.frames()) {
    if (frame->is_keyframe) reach = frame->time;
  }
  const auto old = std::lower_bound(
      wheels_.begin(), wheels_.end(), reach,
      [](const WheelOdometry& odometry, TimeNs time) { return odometry.time < time; });
  if (old - wheels_.begin() > 1) wheels_.erase(wheels_.begin(), old - 1);
}

std::vector<std::string> VisualInertialOdometry::Notices() const {
  std::vector<std::string> notices = quality_.Notices();
  if (!is_running()) notices.push_back("visual–inertial odometry never started");
  if (!start_notice_.empty()) notices.push_back(start_notice_);
  if (unexplained_images_ > 0) {
    notices.push_back(Concatenate("the first ", unexplained_images_,
                                  " images did not tell how the camera moves: no poses for them"));
  }
  for (const auto& [reason, count] : failures_) {
    notices.push_back(
        Concatenate("visual–inertial odometry started anew ", count, " times: ", reason));
  }
  return notices;
}

}  // namespace regolith
