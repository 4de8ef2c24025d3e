// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "regolith/geometry/trajectory.h"
#include "regolith/lio/inertial_filter.h"
#include "regolith/lio/lidar_odometry_options.h"
#include "regolith/lio/scan_odometry.h"
#include "regolith/sensor/imu_sample.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/wheel_odometry.h"

namespace regolith {

/// What IMU and wheels say of the motion between scans: collects their samples, starts the filter
/// when there are enough, and moves it on when asked to.
class InertialTracker {
 public:
  /// The rig has an IMU.
  InertialTracker(const LidarOdometryOptions& options, const RigCalibration& rig);

  void AddImu(const ImuSample& sample);
  void AddWheels(const WheelOdometry& odometry);
  void AddVelocity(const BodyVelocity& velocity) { velocities_.push_back(velocity); }

  enum class State { kWaiting, kRunning, kUnusable };
  State state() const { return state_; }
  /// Starts the filter where enough samples are there; `all`: with what there is. Throws InputError
  /// where the IMU's units or the rig's gravity cannot be right.
  void TryToStart(bool all);

  /// Starts the filter in the midst of a drive, at a pose that was known without it and with the
  /// velocity there (m/s, world). False until enough samples are there, from before it and after.
  bool Join(const StampedPose& pose, const Eigen::Vector3d& v_world_imu);

  bool has_samples() const { return !samples_.empty(); }
  TimeNs last_sample_time() const { return samples_.back().time; }  ///< there is one
  InertialFilter& filter() { return *filter_; }                     ///< while running
  const InertialFilter& filter() const { return *filter_; }

  /// Moves the filter to `end` and gives the poses on the way, its present one first. Wheels are
  /// absorbed where they were measured.
  std::vector<StampedPose> PropagateTo(TimeNs end);

  /// The filter has absorbed a pose whose six directions a scan told.
  void NotePlaced() { placed_ = filter_->state().time; }

  /// Whether velocities that others told were absorbed on the way of the last PropagateTo.
  bool TookVelocities() const { return took_velocities_; }

  /// Whether the rover stands: the last samples are still, and the filter says so too. Absorbs
  /// that.
  bool AbsorbRest();

  /// Drops samples that lie behind.
  void Forget();

  std::vector<std::string> Notices() const;

 private:
  struct Gap {
    TimeNs begin = 0;
    TimeNs end = 0;
  };

  void CheckGravity(const ImuStatistics& statistics) const;
  std::optional<RestReport> FirstSamples();
  void Step(const ImuSample& from, const ImuSample& to);

  LidarOdometryOptions options_;
  RigCalibration rig_;
  State state_ = State::kWaiting;
  std::vector<ImuSample> samples_;  ///< from a rest window before the filter's time on
  std::deque<Gap> gaps_;
  std::deque<WheelOdometry> wheels_;
  std::deque<BodyVelocity> velocities_;
  bool took_velocities_ = false;
  TimeNs distrusted_until_ = 0;  ///< velocities before it are left out
  size_t distrusted_count_ = 0;
  std::optional<TimeNs> placed_;  ///< of the last NotePlaced
  std::optional<InertialFilter> filter_;
  TimeNs last_rest_ = 0;  ///< end of the last window of rest that was absorbed
  size_t gap_count_ = 0;
  double longest_gap_ = 0.0;
  std::string start_notice_;
};

}  // namespace regolith
