// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/lego_loam.h"

#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "regolith/cloud/downsample.h"
#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"
#include "regolith/registration/deskew.h"

namespace regolith {
namespace {

const LidarCalibration& LidarOf(const RigCalibration& rig) {
  REGOLITH_CHECK(rig.lidar.has_value(), "the rig has no lidar");
  return *rig.lidar;
}

void Append(const std::vector<RingPoint>& points, std::vector<Eigen::Vector3d>* positions) {
  for (const RingPoint& point : points) positions->push_back(point.position);
}

FeatureCloud CloudOf(const ScanFeatures& features, const FeatureMapOptions& options) {
  std::vector<Eigen::Vector3d> edges;
  Append(features.edges, &edges);
  FeatureCloud cloud;
  for (const uint32_t kept : DownsampleIndices(edges, options.edge_spacing)) {
    cloud.edges.push_back(edges[kept]);
  }
  Append(features.ground_planars, &cloud.planars);
  Append(features.cluster_planars, &cloud.planars);
  return cloud;
}

}  // namespace

void LegoLoamOptions::Check() const {
  segmentation.Check();
  odometry.Check();
  map.Check();
  keyframes.Check();
  REGOLITH_CHECK(velocity_rotation_sigma > 0.0,
                 "velocity_rotation_sigma=", velocity_rotation_sigma);
  REGOLITH_CHECK(velocity_position_sigma > 0.0,
                 "velocity_position_sigma=", velocity_position_sigma);
  REGOLITH_CHECK(independence > 0.0 && independence <= 1.0, "independence=", independence);
}

LegoLoam::LegoLoam(const LegoLoamOptions& options, const RigCalibration& rig, ThreadPool* threads)
    : options_(options),
      lidar_(LidarOf(rig)),
      up_lidar_(lidar_.T_imu_lidar.rotation.conjugate() * Eigen::Vector3d::UnitZ()),
      threads_(threads),
      map_(options.map),
      graph_(options.keyframes, options.map) {
  options.Check();
}

std::vector<ScanEstimate> LegoLoam::AddImu(const ImuSample&) { return {}; }

std::vector<ScanEstimate> LegoLoam::AddWheels(const WheelOdometry&) { return {}; }

std::vector<ScanEstimate> LegoLoam::AddScan(const LidarScan& scan) {
  if (!scan_poses_.empty() && scan.stamp <= scan_poses_.back().stamp) {
    ++late_scans_;
    return {};
  }
  return {Estimate(scan)};
}

std::vector<ScanEstimate> LegoLoam::Finish() { return {}; }

std::vector<Eigen::Vector3d> LegoLoam::RemoveMotion(const LidarScan& scan, TimeNs reference) const {
  const ScanInterval interval = IntervalOf(scan);
  std::vector<StampedPose> motion;
  for (const TimeNs time : {interval.begin, interval.end}) {
    if (!motion.empty() && time <= motion.back().time) continue;
    const double way = options_.deskew ? SecondsBetween(reference, time) : 0.0;
    motion.push_back({time, ExpSe3(velocity_lidar_ * way)});
  }
  return Deskew(scan, SE3(), motion, SE3());
}

SE3 LegoLoam::ToBody(const SE3& T_map_lidar) const {
  return lidar_.T_imu_lidar * T_map_lidar * lidar_.T_imu_lidar.Inverse();
}

Matrix6d LegoLoam::BodyCovariance(const MapMatch& match) const {
  Vector6d prior;
  prior << Eigen::Vector3d::Constant(std::pow(options_.velocity_rotation_sigma, -2)),
      Eigen::Vector3d::Constant(std::pow(options_.velocity_position_sigma, -2));
  Matrix6d information = prior.asDiagonal();
  if (match.used_scan) {
    information += options_.independence / (match.scale * match.scale) * match.system.information;
  }
  // The body is at c in the lidar's frame: p_body = R_body_lidar (p_lidar + R_map_lidar c) + …
  const Eigen::Matrix3d R_body_lidar = lidar_.T_imu_lidar.rotation.toRotationMatrix();
  const Eigen::Vector3d c = lidar_.T_imu_lidar.Inverse().translation;
  Matrix6d jacobian = Matrix6d::Zero();
  jacobian.topLeftCorner<3, 3>() = R_body_lidar;
  jacobian.bottomLeftCorner<3, 3>() =
      -R_body_lidar * match.T_map_lidar.rotation.toRotationMatrix() * Hat(c);
  jacobian.bottomRightCorner<3, 3>() = R_body_lidar;
  return jacobian * information.ldlt().solve(Matrix6d::Identity()) * jacobian.transpose();
}

ScanEstimate LegoLoam::Estimate(const LidarScan& scan) {
  Stopwatch stopwatch;
  const SegmentedScan segmented = SegmentScan(scan, lidar_.rings, up_lidar_, options_.segmentation);
  if (scan.points.empty()) ++empty_scans_;
  if (segmented.rings_reordered) ++reordered_scans_;
  invalid_points_ += static_cast<size_t>(segmented.invalid_points);
  stopwatch.Lap("segmentation");

  // The pose is estimated at the middle of the sweep, where a wrong velocity moves as many points
  // forward as back.
  const ScanInterval interval = IntervalOf(scan);
  const TimeNs middle = interval.begin + (interval.end - interval.begin) / 2;
  const std::vector<Eigen::Vector3d> points_lidar = RemoveMotion(scan, middle);
  const ScanFeatures features = PlaceFeatures(segmented, points_lidar, options_.map.planar_spacing);
  SE3 guess;
  if (last_) {
    const SE3 predicted = ExpSe3(velocity_lidar_ * SecondsBetween(last_->time, middle));
    guess = last_->T_world_body * MatchTwoStep(features, last_features_, predicted, up_lidar_,
                                               options_.odometry, threads_)
                                      .T_last_current;
  }
  stopwatch.Lap("scan_to_scan");

  const FeatureCloud cloud = CloudOf(features, options_.map);
  const MapMatch match = map_.Match(cloud, guess, threads_);
  if (last_ && !match.used_scan) ++guessed_scans_;
  Track(match.T_map_lidar, middle);
  last_features_ = FeatureTarget(features);
  stopwatch.Lap("scan_to_map");

  ScanEstimate estimate;
  estimate.stamp = scan.stamp;
  const SE3 T_map_lidar =
      match.T_map_lidar * ExpSe3(velocity_lidar_ * SecondsBetween(middle, scan.stamp));
  estimate.T_world_body = ToBody(T_map_lidar);
  estimate.covariance = BodyCovariance(match);
  estimate.leader = match.used_scan ? "lidar" : "guess";
  estimate.match.T_map_body = ToBody(match.T_map_lidar);
  estimate.match.covariance = estimate.covariance;
  estimate.match.used_scan = match.used_scan;
  estimate.match.observable.degenerate_directions = match.degenerate_directions;
  estimate.match.system.points = static_cast<int>(cloud.edges.size() + cloud.planars.size());
  estimate.match.system.matches = match.system.matches;
  estimate.match.system.inliers = match.system.inliers;
  estimate.match.system.scale = match.scale;
  estimate.points.resize(points_lidar.size());
  const SE3 T_world_lidar = lidar_.T_imu_lidar * match.T_map_lidar;
  for (size_t i = 0; i < points_lidar.size(); ++i) {
    estimate.points[i] = {(T_world_lidar * points_lidar[i]).cast<float>(),
                          scan.points[i].intensity};
  }

  Extend(cloud, middle);
  const size_t keyframe = graph_.keyframes().size() - 1;
  scan_poses_.push_back({scan.stamp, keyframe,
                         graph_.keyframes()[keyframe].T_map_lidar.Inverse() * last_->T_world_body *
                             ExpSe3(velocity_lidar_ * SecondsBetween(middle, scan.stamp))});
  stopwatch.Lap("keyframes");
  estimate.stages = stopwatch.stages();
  return estimate;
}

void LegoLoam::Track(const SE3& T_map_lidar, TimeNs time) {
  if (last_ && time > last_->time) {
    velocity_lidar_ =
        LogSe3(last_->T_world_body.Inverse() * T_map_lidar) / SecondsBetween(last_->time, time);
  }
  last_ = StampedPose{time, T_map_lidar};
}

void LegoLoam::Extend(const FeatureCloud& cloud, TimeNs time) {
  if (!graph_.IsNew(last_->T_world_body)) return;
  graph_.Add({time, last_->T_world_body, cloud});
  if (graph_.CloseLoop(threads_)) {
    last_->T_world_body = graph_.keyframes().back().T_map_lidar;
    RebuildMap();
    return;
  }
  map_.Add(cloud, last_->T_world_body);
  map_.ForgetFarFrom(last_->T_world_body.translation);
}

void LegoLoam::RebuildMap() {
  map_ = FeatureMap(options_.map);
  const Eigen::Vector3d& centre = last_->T_world_body.translation;
  // The newest first: they take the places of older ones.
  const std::vector<Keyframe>& keyframes = graph_.keyframes();
  for (auto keyframe = keyframes.rbegin(); keyframe != keyframes.rend(); ++keyframe) {
    const double distance = (keyframe->T_map_lidar.translation - centre).norm();
    if (distance < options_.map.radius) map_.Add(keyframe->cloud, keyframe->T_map_lidar);
  }
  map_.ForgetFarFrom(centre);
}

std::optional<Trajectory> LegoLoam::Refined() const {
  Trajectory trajectory;
  for (const ScanPose& scan : scan_poses_) {
    const SE3& T_map_keyframe = graph_.keyframes()[scan.keyframe].T_map_lidar;
    trajectory.Append({scan.stamp, ToBody(T_map_keyframe * scan.T_keyframe_lidar)});
  }
  return trajectory;
}

KeyframeCounts LegoLoam::Counts() const {
  return {graph_.keyframes().size(), graph_.loops_accepted(), graph_.loops_rejected()};
}

std::vector<std::string> LegoLoam::Notices() const {
  std::vector<std::string> notices;
  const auto add = [&](size_t count, const std::string& what) {
    if (count > 0) notices.push_back(Concatenate(count, what));
  };
  add(empty_scans_, " scans had no points");
  add(guessed_scans_, " scans had too few features: their poses are constant velocity's");
  add(late_scans_, " scans came no later than the one before and have no pose");
  add(reordered_scans_, " scans had rings out of order: they are ordered by elevation");
  add(invalid_points_, " points were not finite or of rings that the lidar has not");
  return notices;
}

}  // namespace regolith
