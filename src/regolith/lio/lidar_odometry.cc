// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/lidar_odometry.h"

#include <algorithm>
#include <cmath>

#include "regolith/cloud/downsample.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/imu/propagation.h"
#include "regolith/registration/deskew.h"

namespace regolith {
namespace {

// Scans that wait longer than this for the IMU are estimated without it.
constexpr double kMostWaiting = 1.0;  // s
constexpr size_t kScansBetweenRemovals = 10;
constexpr double kEarthGravity = 9.81;

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
  matcher.planes.Check();
  rest.Check();
  REGOLITH_CHECK(scan_voxel_size > 0.0, "scan_voxel_size=", scan_voxel_size);
  REGOLITH_CHECK(map_levels >= 1 && map_levels <= 4, "map_levels=", map_levels);
  REGOLITH_CHECK(map_growth > 1.0, "map_growth=", map_growth);
  REGOLITH_CHECK(initialization_window >= rest.min_duration,
                 "initialization_window=", initialization_window);
  REGOLITH_CHECK(rest_window >= rest.min_duration, "rest_window=", rest_window);
  REGOLITH_CHECK(max_imu_gap > 0.0, "max_imu_gap=", max_imu_gap);
}

LidarOdometry::LidarOdometry(const LidarOdometryOptions& options, const RigCalibration& rig,
                             ThreadPool* threads)
    : options_(options), rig_(rig), threads_(threads) {
  options.Check();
  VoxelMapOptions level = options.map;
  for (int i = 0; i < options.map_levels; ++i, level.voxel_size *= options.map_growth) {
    maps_.emplace_back(level);
  }
  REGOLITH_CHECK(rig.lidar.has_value(), "the rig has no lidar");
  options_.imu = options.imu && rig.imu.has_value();
  T_body_lidar_ = rig.lidar->T_imu_lidar;
}

std::vector<ScanEstimate> LidarOdometry::AddImu(const ImuSample& sample) {
  if (!options_.imu) return {};
  if (!samples_.empty()) {
    const double step = SecondsBetween(samples_.back().time, sample.time);
    if (step <= 0.0) return {};
    if (step > options_.max_imu_gap) {
      gaps_.push_back({samples_.back().time, sample.time});
      ++gap_count_;
      longest_gap_ = std::max(longest_gap_, step);
    }
  }
  samples_.push_back(sample);
  return EstimateReady(false);
}

std::vector<ScanEstimate> LidarOdometry::AddWheels(const WheelOdometry& /*odometry*/) { return {}; }

std::vector<ScanEstimate> LidarOdometry::AddScan(const LidarScan& scan) {
  waiting_.push_back(scan);
  return EstimateReady(false);
}

std::vector<ScanEstimate> LidarOdometry::Finish() { return EstimateReady(true); }

bool LidarOdometry::IsReady(const LidarScan& scan) const {
  if (!options_.imu) return true;
  const TimeNs end = IntervalOf(scan).end;
  const bool imu_is_late = SecondsBetween(end, waiting_.back().stamp) > kMostWaiting;
  return (!samples_.empty() && samples_.back().time >= end) || imu_is_late;
}

std::vector<ScanEstimate> LidarOdometry::EstimateReady(bool all) {
  if (options_.imu && !filter_) {
    const double span =
        samples_.empty() ? 0.0 : SecondsBetween(samples_.front().time, samples_.back().time);
    if (span >= options_.initialization_window || (all && samples_.size() > 1)) Initialize();
  }
  std::vector<ScanEstimate> estimates;
  while (!waiting_.empty() && (all || IsReady(waiting_.front()))) {
    const LidarScan scan = std::move(waiting_.front());
    if (options_.imu && !filter_) {
      // The world begins at the first IMU pose: until the filter has started a scan can only wait.
      if (!samples_.empty() && !all) {
        waiting_.front() = scan;
        break;
      }
      ++early_scans_;
    } else if (options_.imu && IntervalOf(scan).end < filter_->state().time && scans_ == 0) {
      ++early_scans_;
    } else {
      if (scan.points.empty()) ++empty_scans_;
      estimates.push_back(options_.imu ? EstimateInertial(scan) : EstimateLidarOnly(scan));
      ++scans_;
    }
    waiting_.pop_front();
  }
  return estimates;
}

void LidarOdometry::CheckGravity(const ImuStatistics& statistics) const {
  const double force = statistics.mean_specific_force.norm();
  const double ratio = force / rig_.gravity;
  if (ratio > 0.5 && ratio < 2.0) return;
  const double in_g = ratio * kEarthGravity;
  throw InputError(
      rig_.imu->topic,
      Concatenate("mean specific force at the start is ", force, ", but gravity in the rig is ",
                  rig_.gravity, " m/s²; ",
                  in_g > 0.8 && in_g < 1.2 ? "the samples look to be in g, expected m/s²"
                                           : "check `gravity` in the rig and the IMU's units"));
}

void LidarOdometry::Initialize() {
  const double rate = static_cast<double>(samples_.size() - 1) /
                      SecondsBetween(samples_.front().time, samples_.back().time);
  if (rate < options_.min_imu_rate) {
    options_.imu = false;
    start_notice_ = Concatenate("the IMU comes at ", rate, " Hz, below ", options_.min_imu_rate,
                                " Hz: it is not used, and the world is not level");
    return;
  }
  const RestReport report = DetectRest(samples_, rig_.gravity, options_.rest);
  CheckGravity(report.statistics);
  if (!report.at_rest) {
    start_notice_ = "the recording does not start at rest (" + report.reason +
                    "): the first attitude, velocity and biases are rough";
  }
  filter_.emplace(samples_.front().time, report, rig_.gravity, rig_.imu->noise, options_.filter);
}

void LidarOdometry::PropagateStep(const ImuSample& from, const ImuSample& to) {
  const bool in_gap = std::any_of(gaps_.begin(), gaps_.end(), [&](const Gap& gap) {
    return from.time >= gap.begin && to.time <= gap.end;
  });
  if (in_gap || from.time >= samples_.back().time) {
    filter_->PropagateBlindly(to.time);
  } else {
    filter_->Propagate(from, to);
  }
}

std::vector<StampedPose> LidarOdometry::PropagateTo(TimeNs end) {
  std::vector<StampedPose> motion = {{filter_->state().time, filter_->state().T_world_imu}};
  if (end <= filter_->state().time) return motion;
  const std::vector<ImuSample> steps = SamplesBetween(samples_, filter_->state().time, end);
  for (size_t i = 1; i < steps.size(); ++i) {
    if (steps[i].time <= steps[i - 1].time) continue;
    PropagateStep(steps[i - 1], steps[i]);
    motion.push_back({filter_->state().time, filter_->state().T_world_imu});
  }
  return motion;
}

std::optional<ImuStatistics> LidarOdometry::RestStatistics(TimeNs time) const {
  if (filter_->state().v_world_imu.norm() > options_.rest_max_speed) return std::nullopt;
  const TimeNs begin = AddSeconds(time, -options_.rest_window);
  if (samples_.empty() || samples_.front().time > begin || samples_.back().time < time) {
    return std::nullopt;
  }
  const std::vector<ImuSample> window = SamplesBetween(samples_, begin, time);
  const RestReport report = DetectRest(window, rig_.gravity, options_.rest);
  if (!report.at_rest) return std::nullopt;
  return report.statistics;
}

ScanMatch LidarOdometry::Match(const std::vector<Eigen::Vector3d>& points_body, const SE3& prior,
                               const Matrix6d& covariance) {
  std::vector<Eigen::Vector3d> thinned;
  for (const uint32_t index : DownsampleIndices(points_body, options_.scan_voxel_size)) {
    thinned.push_back(points_body[index]);
  }
  return MatchScan(thinned, prior, covariance, maps_, options_.matcher, threads_);
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
  for (VoxelMap& map : maps_) {
    map.Add(points_world);
    if (scans_ % kScansBetweenRemovals == 0) map.RemoveFarFrom(T_world_body.translation);
  }
  return map_points;
}

ScanEstimate LidarOdometry::EstimateInertial(const LidarScan& scan) {
  Stopwatch stopwatch;
  ScanEstimate estimate;
  estimate.stamp = scan.stamp;
  const std::vector<StampedPose> motion = PropagateTo(IntervalOf(scan).end);
  const SE3 predicted = motion.back().T_world_body;
  const auto points_body = Deskew(scan, T_body_lidar_, motion, predicted);
  const std::optional<ImuStatistics> rest = RestStatistics(filter_->state().time);
  if (rest) filter_->AbsorbRest(*rest);
  estimate.at_rest = rest.has_value();
  stopwatch.Lap("deskew");

  const SE3 prior = filter_->state().T_world_imu;
  estimate.match = Match(points_body, prior, filter_->PoseCovariance());
  if (estimate.match.used_scan) {
    filter_->AbsorbPose(estimate.match.T_map_body, estimate.match.covariance);
  }
  stopwatch.Lap("match");

  const SE3 corrected = filter_->state().T_world_imu;
  estimate.T_world_body = corrected * (predicted.Inverse() * PoseAt(motion, scan.stamp));
  estimate.covariance = filter_->PoseCovariance();
  estimate.gyro_bias = filter_->state().gyro_bias;
  estimate.leader = estimate.match.used_scan ? "lidar+imu" : "imu";
  estimate.points = ExtendMap(scan, points_body, corrected);
  stopwatch.Lap("map");
  estimate.stages = stopwatch.stages();

  const TimeNs needed = AddSeconds(filter_->state().time, -2.0 * options_.rest_window);
  const auto first =
      std::lower_bound(samples_.begin(), samples_.end(), needed,
                       [](const ImuSample& sample, TimeNs time) { return sample.time < time; });
  if (first != samples_.end()) samples_.erase(samples_.begin(), first);
  while (!gaps_.empty() && gaps_.front().end < filter_->state().time) gaps_.pop_front();
  return estimate;
}

ScanEstimate LidarOdometry::EstimateLidarOnly(const LidarScan& scan) {
  Stopwatch stopwatch;
  ScanEstimate estimate;
  estimate.stamp = scan.stamp;
  // The pose is estimated at the middle of the sweep, where a wrong velocity moves as many points
  // forward as back; estimated at an end, velocity and pose would excite each other.
  const ScanInterval interval = IntervalOf(scan);
  const TimeNs middle = interval.begin + (interval.end - interval.begin) / 2;
  const SE3 prior =
      last_ ? last_->T_world_body * ExpSe3(velocity_body_ * SecondsBetween(last_->time, middle))
            : SE3();
  std::vector<StampedPose> motion;
  for (const TimeNs time : {interval.begin, interval.end}) {
    if (!motion.empty() && time <= motion.back().time) continue;
    motion.push_back({time, prior * ExpSe3(velocity_body_ * SecondsBetween(middle, time))});
  }
  const auto points_body = Deskew(scan, T_body_lidar_, motion, prior);
  stopwatch.Lap("deskew");

  const Matrix6d covariance =
      MotionCovariance(options_.velocity_rotation_sigma, options_.velocity_position_sigma);
  estimate.match = Match(points_body, prior, covariance);
  const SE3 pose = estimate.match.T_map_body;
  estimate.covariance = estimate.match.covariance;
  estimate.leader = estimate.match.used_scan ? "lidar" : "guess";
  stopwatch.Lap("match");

  if (last_ && middle > last_->time) {
    velocity_body_ =
        LogSe3(last_->T_world_body.Inverse() * pose) / SecondsBetween(last_->time, middle);
  }
  last_ = StampedPose{middle, pose};
  estimate.T_world_body = pose * ExpSe3(velocity_body_ * SecondsBetween(middle, scan.stamp));
  estimate.points = ExtendMap(scan, points_body, pose);
  stopwatch.Lap("map");
  estimate.stages = stopwatch.stages();
  return estimate;
}

std::vector<std::string> LidarOdometry::Notices() const {
  std::vector<std::string> notices;
  if (!start_notice_.empty()) notices.push_back(start_notice_);
  if (gap_count_ > 0) {
    notices.push_back(Concatenate(gap_count_, " gaps in the IMU, the longest ", longest_gap_,
                                  " s, were bridged by constant velocity"));
  }
  if (early_scans_ > 0) {
    notices.push_back(
        Concatenate(early_scans_, " scans came before the first IMU sample and have no pose"));
  }
  if (empty_scans_ > 0) notices.push_back(Concatenate(empty_scans_, " scans had no points"));
  return notices;
}

}  // namespace regolith
