// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/keyframe_store.h"

#include <cmath>
#include <utility>

#include "regolith/cloud/downsample.h"

namespace regolith {

void KeyframeStore::Append(TimeNs time, double way, Span<const Eigen::Vector3d> points_body) {
  std::vector<Eigen::Vector3d> near;
  for (const Eigen::Vector3d& point : points_body) {
    if (point.squaredNorm() <= options_.radius * options_.radius) near.push_back(point);
  }
  BackendKeyframe keyframe;
  keyframe.time = time;
  keyframe.way = way;
  for (const uint32_t index : DownsampleIndices(near, options_.point_spacing)) {
    keyframe.points_body.push_back(near[index].cast<float>());
  }
  keyframes_.push_back(std::move(keyframe));
}

void KeyframeStore::DescribeNewest(const FactorGraph& graph, const OdometryChain& odometry) {
  const size_t newest = keyframes_.size() - 1;
  std::vector<Eigen::Vector3d> points = Submap(newest, 0, keyframes_.size(), graph, odometry);
  const Eigen::Quaterniond R_world_body = graph.pose(newest).rotation;
  for (Eigen::Vector3d& point : points) point = R_world_body * point;
  const ReliefImage relief(points, relief_);
  keyframes_.back().descriptor = DescribeRelief(relief.cells(), relief_.radius);
}

void KeyframeStore::ForgetPoints(size_t index) {
  keyframes_[index].points_body = std::vector<Eigen::Vector3f>();
}

std::vector<Eigen::Vector3d> KeyframeStore::Submap(size_t index, size_t first, size_t last,
                                                   const FactorGraph& graph,
                                                   const OdometryChain& odometry) const {
  std::vector<Eigen::Vector3d> points;
  const SE3 T_body_world = graph.pose(index).Inverse();
  const auto add = [&](size_t i) {
    const SE3 T_body_other = T_body_world * graph.pose(i);
    for (const Eigen::Vector3f& point : keyframes_[i].points_body) {
      points.push_back(T_body_other * point.cast<double>());
    }
  };
  const auto is_near = [&](size_t i) {
    const double way = std::abs(keyframes_[i].way - keyframes_[index].way);
    const double variance = odometry.Between(index, i).covariance.bottomRightCorner<3, 3>().trace();
    return way <= options_.submap_length &&
           variance <= options_.submap_sigma * options_.submap_sigma;
  };
  // Its own points first: they take the places in the maps.
  add(index);
  for (size_t i = index; i > first && is_near(i - 1); --i) add(i - 1);
  for (size_t i = index + 1; i < last && is_near(i); ++i) add(i);
  return points;
}

}  // namespace regolith
