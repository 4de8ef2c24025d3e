// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/place_observer.h"

#include <utility>

#include "regolith/system/lidar_distances.h"

namespace regolith {
namespace {

std::unique_ptr<FeatureExtractor> OrbOf(FeatureOptions options) {
  options.frontend = "orb";
  return FeatureExtractor::Create(options, std::nullopt);
}

}  // namespace

PlaceObserver::PlaceObserver(const PipelineOptions& options, const RigCalibration& rig,
                             std::optional<Image> mask)
    : T_imu_camera_(rig.cameras.at(options.tracked_camera).T_imu_camera),
      T_imu_lidar_(rig.lidar->T_imu_lidar),
      mask_(std::move(mask)),
      max_keypoints_(options.visual_loops.max_keypoints),
      camera_(CameraModel::Create(rig.cameras.at(options.tracked_camera).intrinsics)),
      extractor_(OrbOf(options.features)),
      depth_(options.lidar_depth) {}

PlaceView PlaceObserver::Observe(const KeyframeSight& sight, const SE3& T_odom_body) {
  for (const auto& scan : sight.scans) AddReturns(*scan, T_imu_lidar_, &depth_);
  FeatureSet features;
  extractor_->Extract(sight.frame->image, mask_ ? &*mask_ : nullptr, max_keypoints_, &features);

  PlaceView view;
  const SE3 T_odom_camera = sight.T_odom_body * T_imu_camera_;
  view.T_body_camera = T_odom_body.Inverse() * T_odom_camera;
  view.descriptors.ResetLike(features.descriptors);
  for (size_t i = 0; i < features.size(); ++i) {
    const auto bearing = camera_->Unproject(features.pixels[i].cast<double>());
    if (!bearing) continue;
    view.bearings.push_back(*bearing);
    view.descriptors.Append(features.descriptors, i);
  }
  for (const auto& distance : depth_.Distances(T_odom_camera, view.bearings)) {
    view.ranges.push_back(distance ? distance->distance : 0.0);
  }
  return view;
}

}  // namespace regolith
