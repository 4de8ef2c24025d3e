// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/lidar_odometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/imu/wheel_preintegration.h"
#include "regolith/registration/deskew.h"

namespace regolith {
namespace {

// Scans that wait longer than this for the IMU are estimated without it.
constexpr double kMostWaiting = 1.0;  // s
// Of the points beside jumps of the range: rocky ground has a quarter.
constexpr double kMostAtJumps = 0.5;
// An IMU that has said too little to start and then nothing for so long is given up.
constexpr double kMostSilent = 3.0;  // s

SE3 PoseAt(const std::vector<StampedPose>& motion, TimeNs time) {
  if (time <= motion.front().time) return motion.front().T_world_body;
  if (time >= motion.back().time) return motion.back().T_world_body;
  return *Trajectory(motion).At(time);
}

Matrix6d MotionCovariance(double rotation_sigma, double position_sigma) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(rotation_sigma * rotation_sigma),
      Eigen::Vector3d::Constant(position_sigma * position_sigma);
  return variances.asDiagonal();
}

}  // namespace

void LidarOdometryOptions::Check() const {
  map.Check();
  range_jumps.Check();
  matcher.Check();
  feature_matcher.Check();
  rest.Check();
  wheel_motion.Check();
  drift.Check();
  if (!lidar && !imu) throw InputError("lio", "lidar and imu are both off; expected one of them");
  REGOLITH_CHECK(scan_voxel_size > 0.0, "scan_voxel_size=", scan_voxel_size);
  REGOLITH_CHECK(max_points >= 100, "max_points=", max_points);
  REGOLITH_CHECK(map_levels >= 1 && map_levels <= 4, "map_levels=", map_levels);
  REGOLITH_CHECK(map_growth > 1.0, "map_growth=", map_growth);
  REGOLITH_CHECK(initialization_window >= rest.min_duration,
                 "initialization_window=", initialization_window);
  REGOLITH_CHECK(rest_window >= rest.min_duration, "rest_window=", rest_window);
  REGOLITH_CHECK(max_lost_sigma > 0.0, "max_lost_sigma=", max_lost_sigma);
  REGOLITH_CHECK(max_imu_gap > 0.0, "max_imu_gap=", max_imu_gap);
}

LidarOdometry::LidarOdometry(const LidarOdometryOptions& options, const RigCalibration& rig,
                             ThreadPool* threads)
    : options_(options),
      rig_(rig),
      threads_(threads),
      map_(options, rig.lidar ? rig.lidar->rings : 0),
      drift_(options.drift) {
  options.Check();
  REGOLITH_CHECK(rig.lidar.has_value() || !options.lidar, "the rig has no lidar");
  if (rig.lidar) T_body_lidar_ = rig.lidar->T_imu_lidar;
  if (options.wheels && rig.wheels) T_body_base_ = rig.wheels->T_imu_base;
  if (options.imu && rig.imu) inertial_.emplace(options, rig);
}

std::vector<ScanEstimate> LidarOdometry::AddImu(const ImuSample& sample) {
  if (inertial_) {
    inertial_->AddImu(sample);
  } else if (silent_imu_) {
    TakeUpImu(sample);
  }
  return EstimateReady(false);
}

std::vector<ScanEstimate> LidarOdometry::AddWheels(const WheelOdometry& odometry) {
  if (!T_body_base_) return {};
  wheels_came_ = true;
  if (inertial_) {
    inertial_->AddWheels(odometry);
  } else {
    wheels_.push_back(odometry);
  }
  return EstimateReady(false);
}

void LidarOdometry::AddVelocity(const BodyVelocity& velocity) {
  if (inertial_) inertial_->AddVelocity(velocity);
}

std::vector<ScanEstimate> LidarOdometry::AddScan(const LidarScan& scan) {
  waiting_.push_back({scan, true});
  std::vector<LidarPoint>& points = waiting_.back().scan.points;
  const auto finite = [](const LidarPoint& point) {
    return point.position.allFinite() && std::isfinite(point.time);
  };
  const auto end = std::stable_partition(points.begin(), points.end(), finite);
  invalid_points_ += static_cast<size_t>(points.end() - end);
  points.erase(end, points.end());
  return EstimateReady(false);
}

std::vector<ScanEstimate> LidarOdometry::AddStamp(TimeNs time) {
  Waiting waiting;
  waiting.scan.stamp = time;
  waiting.is_scan = false;
  waiting_.push_back(std::move(waiting));
  return EstimateReady(false);
}

std::vector<ScanEstimate> LidarOdometry::Finish() { return EstimateReady(true); }

bool LidarOdometry::IsReady(const LidarScan& scan) const {
  const TimeNs end = IntervalOf(scan).end;
  const bool is_late = SecondsBetween(end, waiting_.back().scan.stamp) > kMostWaiting;
  if (is_late) return true;
  if (inertial_) return inertial_->has_samples() && inertial_->last_sample_time() >= end;
  return !wheels_came_ || (!wheels_.empty() && wheels_.back().time >= end);
}

/// An IMU that is too slow, or does not come at all.
void LidarOdometry::GiveUpImu(bool all) {
  inertial_->TryToStart(all);
  const bool is_waiting = inertial_->state() == InertialTracker::State::kWaiting;
  const TimeNs since = inertial_->has_samples() ? inertial_->last_sample_time()
                       : waiting_.empty()       ? 0
                                                : waiting_.front().scan.stamp;
  const bool is_silent = is_waiting && !waiting_.empty() &&
                         SecondsBetween(since, waiting_.back().scan.stamp) > kMostSilent;
  if (inertial_->state() != InertialTracker::State::kUnusable && !(is_silent && options_.lidar)) {
    return;
  }
  unusable_imu_ = std::exchange(inertial_, {});
  imu_was_silent_ = is_silent;
  if (is_silent) silent_imu_.emplace(options_, rig_);
}

/// One that was given up and speaks again: it goes on from the last pose without it.
void LidarOdometry::TakeUpImu(const ImuSample& sample) {
  silent_imu_->AddImu(sample);
  if (!last_) return;
  const Eigen::Vector3d v_world = last_->T_world_body.rotation * velocity_body_.tail<3>();
  if (!silent_imu_->Join(*last_, v_world)) {
    // Too slow an IMU stays unused, and is said.
    if (silent_imu_->state() == InertialTracker::State::kUnusable) {
      unusable_imu_ = std::exchange(silent_imu_, {});
    }
    return;
  }
  inertial_ = std::exchange(silent_imu_, {});
  for (const WheelOdometry& sample_of_wheels : wheels_) inertial_->AddWheels(sample_of_wheels);
  wheels_.clear();
}

/// Whether the next one is to be estimated at all; counts those that are not.
bool LidarOdometry::CanEstimate(const Waiting& waiting) {
  const LidarScan& scan = waiting.scan;
  if (inertial_ && (inertial_->state() == InertialTracker::State::kWaiting ||
                    (scans_ == 0 && IntervalOf(scan).end < inertial_->filter().state().time))) {
    early_scans_ += waiting.is_scan ? 1 : 0;
    return false;
  }
  if (last_stamp_ && scan.stamp <= *last_stamp_) {
    repeated_scans_ += waiting.is_scan ? 1 : 0;
    return false;
  }
  if (!waiting.is_scan) {
    // With neither IMU nor wheels a pose without a scan would be invented.
    return inertial_ ||
           (last_ && T_body_base_ && scan.stamp > last_->time &&
            PreintegrateWheels(wheels_, last_->time, scan.stamp, options_.wheel_motion));
  }
  empty_scans_ += scan.points.empty() ? 1 : 0;
  return true;
}

std::vector<ScanEstimate> LidarOdometry::EstimateReady(bool all) {
  if (inertial_) GiveUpImu(all);
  std::vector<ScanEstimate> estimates;
  while (!waiting_.empty() && (all || IsReady(waiting_.front().scan))) {
    // The world begins at the first IMU pose: until the filter has started a scan can only wait.
    if (inertial_ && inertial_->state() == InertialTracker::State::kWaiting && !all) break;
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    if (!CanEstimate(next)) continue;
    last_stamp_ = next.scan.stamp;
    estimates.push_back(inertial_ ? EstimateInertial(next.scan) : EstimateWithoutImu(next.scan));
    estimates.back().has_scan = next.is_scan;
    if (!next.is_scan && !inertial_) estimates.back().leader = "wheels";
    ++scans_;
  }
  return estimates;
}

ScanMatch LidarOdometry::Match(const LidarScan& scan,
                               const std::vector<Eigen::Vector3d>& points_body,
                               const Guess& guess) {
  const bool is_map_new = map_.is_new();
  ScanMatch match = map_.Match(scan, points_body, guess.T_world_body, guess.covariance, threads_);
  if (!match.used_scan && !is_map_new && !points_body.empty()) ++unmatched_scans_;
  return match;
}

/// After a time without scans the map may be metres away from where the filter sees it. Matched
/// against its edge the pose would jump, and against itself a new map must not doubt what the
/// filter doubts of the way to it. Old ground is for loop closure to find.
void LidarOdometry::BeginMapWhereLost() {
  InertialFilter& filter = inertial_->filter();
  const Eigen::Matrix3d position = filter.PoseCovariance().bottomRightCorner<3, 3>();
  if (is_placed_ || position.trace() < options_.max_lost_sigma * options_.max_lost_sigma) return;
  map_.Clear();
  drift_.BeginMap(filter.BeginWorld());
  ++maps_begun_;
}

void LidarOdometry::AddDrift(const SE3& T_world_body, ScanEstimate* estimate) {
  // Degenerate directions are as uncertain as the estimate itself says; the map adds nothing.
  if (last_pose_ && estimate->match.used_scan) {
    drift_.Advance(*last_pose_, T_world_body, ObservedCovariance(estimate->match.observable));
  }
  last_pose_ = T_world_body;
  is_placed_ = estimate->match.used_scan;
  estimate->covariance += drift_.covariance();
}

std::vector<MapPoint> LidarOdometry::ExtendMap(const LidarScan& scan,
                                               const std::vector<Eigen::Vector3d>& points_body,
                                               const SE3& T_world_body) {
  std::vector<Eigen::Vector3d> points_world(points_body.size());
  std::vector<MapPoint> map_points(points_body.size());
  for (size_t i = 0; i < points_body.size(); ++i) {
    points_world[i] = T_world_body * points_body[i];
    map_points[i] = {points_world[i].cast<float>(), scan.points[i].intensity};
  }
  map_.Extend(points_world, T_world_body);
  return map_points;
}

ScanEstimate LidarOdometry::EstimateInertial(const LidarScan& scan) {
  Stopwatch stopwatch;
  ScanEstimate estimate;
  estimate.stamp = scan.stamp;
  InertialFilter& filter = inertial_->filter();
  const std::vector<StampedPose> motion = inertial_->PropagateTo(IntervalOf(scan).end);
  const SE3 predicted = motion.back().T_world_body;
  estimate.at_rest = inertial_->AbsorbRest();
  stopwatch.Lap("propagate");

  std::vector<Eigen::Vector3d> points_body;
  if (options_.lidar) {
    points_body = Deskew(scan, T_body_lidar_, motion, predicted);
    stopwatch.Lap("deskew");
    if (!points_body.empty()) BeginMapWhereLost();
    estimate.match =
        Match(scan, points_body, {filter.state().T_world_imu, filter.PoseCovariance()});
    if (estimate.match.used_scan) {
      filter.AbsorbPose(estimate.match.T_map_body, estimate.match.covariance);
      if (estimate.match.observable.degenerate_directions == 0) inertial_->NotePlaced();
    }
    stopwatch.Lap("match");
  }

  const SE3 corrected = filter.state().T_world_imu;
  estimate.T_world_body = corrected * (predicted.Inverse() * PoseAt(motion, scan.stamp));
  estimate.covariance = filter.PoseCovariance();
  estimate.inertial = InertialState{filter.state(), filter.gravity_world()};
  estimate.leader = estimate.match.used_scan      ? "lidar+imu"
                    : inertial_->TookVelocities() ? "camera+imu"
                    : wheels_came_                ? "wheels+imu"
                                                  : "imu";
  AddDrift(corrected, &estimate);
  if (options_.lidar) {
    estimate.points = ExtendMap(scan, points_body, corrected);
    stopwatch.Lap("map");
  }
  estimate.stages = stopwatch.stages();
  inertial_->Forget();
  return estimate;
}

LidarOdometry::Guess LidarOdometry::GuessAt(TimeNs time) const {
  Guess guess;
  guess.covariance =
      MotionCovariance(options_.velocity_rotation_sigma, options_.velocity_position_sigma);
  if (!last_) return guess;
  if (T_body_base_ && time > last_->time) {
    const auto delta = PreintegrateWheels(wheels_, last_->time, time, options_.wheel_motion);
    if (delta) {
      const SE3 T_base_body = T_body_base_->Inverse();
      guess.T_world_body = last_->T_world_body * (*T_body_base_ * delta->T_from_to * T_base_body);
      return guess;
    }
  }
  guess.T_world_body =
      last_->T_world_body * ExpSe3(velocity_body_ * SecondsBetween(last_->time, time));
  return guess;
}

ScanEstimate LidarOdometry::EstimateWithoutImu(const LidarScan& scan) {
  Stopwatch stopwatch;
  ScanEstimate estimate;
  estimate.stamp = scan.stamp;
  // The pose is estimated at the middle of the sweep, where a wrong velocity moves as many points
  // forward as back; estimated at an end, velocity and pose would excite each other.
  const ScanInterval interval = IntervalOf(scan);
  const TimeNs middle = interval.begin + (interval.end - interval.begin) / 2;
  const Guess guess = GuessAt(middle);
  std::vector<StampedPose> motion;
  for (const TimeNs time : {interval.begin, interval.end}) {
    if (!motion.empty() && time <= motion.back().time) continue;
    motion.push_back(
        {time, guess.T_world_body * ExpSe3(velocity_body_ * SecondsBetween(middle, time))});
  }
  const auto points_body = Deskew(scan, T_body_lidar_, motion, guess.T_world_body);
  stopwatch.Lap("deskew");

  estimate.match = Match(scan, points_body, guess);
  const SE3 pose = estimate.match.T_map_body;
  estimate.covariance = estimate.match.covariance;
  estimate.leader = estimate.match.used_scan ? "lidar" : "guess";
  stopwatch.Lap("match");

  if (last_ && middle > last_->time) {
    velocity_body_ =
        LogSe3(last_->T_world_body.Inverse() * pose) / SecondsBetween(last_->time, middle);
  }
  last_ = StampedPose{middle, pose};
  const auto passed =
      std::find_if(wheels_.begin(), wheels_.end(), [&](const WheelOdometry& sample) {
        return sample.time >= AddSeconds(middle, -kMostWaiting);
      });
  wheels_.erase(wheels_.begin(), passed);
  estimate.T_world_body = pose * ExpSe3(velocity_body_ * SecondsBetween(middle, scan.stamp));
  AddDrift(pose, &estimate);
  estimate.points = ExtendMap(scan, points_body, pose);
  stopwatch.Lap("map");
  estimate.stages = stopwatch.stages();
  return estimate;
}

std::vector<std::string> LidarOdometry::Notices() const {
  std::vector<std::string> notices;
  if (inertial_) notices = inertial_->Notices();
  if (unusable_imu_) notices = unusable_imu_->Notices();
  if (imu_was_silent_) {
    notices.push_back(std::string("the IMU was silent when it should have started: ") +
                      (inertial_ ? "the first scans went" : "scans go") +
                      " without it, and the world is not level");
  }
  if (map_.ShareAtJumps() > kMostAtJumps) {
    notices.push_back(Concatenate(
        std::lround(100.0 * map_.ShareAtJumps()),
        " % of the points lie beside jumps of the range along their ring and were not matched; "
        "check that the rings are right and their points in the order of the turn"));
  }
  const auto add = [&](size_t count, const char* what) {
    if (count > 0) notices.push_back(Concatenate(count, what));
  };
  add(early_scans_, " scans came before the first IMU sample and have no pose");
  add(invalid_points_, " points were not finite and were left out");
  add(empty_scans_, " scans had no points");
  add(unmatched_scans_, " scans met too few planes of the map; the prediction stands for them");
  add(maps_begun_,
      " times scans came back when the rover could be metres off: its map begins anew there, and "
      "old ground is found by loops alone");
  add(repeated_scans_, " scans were not later than the one before and were left out");
  return notices;
}

}  // namespace regolith
