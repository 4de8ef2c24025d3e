// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/visual_places.h"

#include <algorithm>
#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "regolith/core/check.h"
#include "regolith/features/global_descriptor.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

constexpr double kConfidence = 0.9999;  // of RANSAC, that it has met the best pose

}  // namespace

void VisualPlacesOptions::Check() const {
  matcher.Check();
  REGOLITH_CHECK(max_places >= 1, "max_places=", max_places);
  REGOLITH_CHECK(min_inliers >= 6, "min_inliers=", min_inliers);
  REGOLITH_CHECK(angle_error > 0.0, "angle_error=", angle_error);
  REGOLITH_CHECK(iterations >= 1, "iterations=", iterations);
  REGOLITH_CHECK(position_doubt > 0.0 && yaw_doubt > 0.0, "position_doubt=", position_doubt);
}

VisualPlaces::VisualPlaces(const VisualPlacesOptions& options, const SE3& T_body_camera)
    : options_(options), T_body_camera_(T_body_camera), matcher_(options.matcher) {
  options.Check();
}

void VisualPlaces::Add(size_t keyframe, PlaceView view) {
  REGOLITH_CHECK(places_.empty() || keyframe > places_.back().keyframe, "keyframe ", keyframe);
  REGOLITH_CHECK(
      view.bearings.size() == view.descriptors.size() && view.ranges.size() == view.bearings.size(),
      view.bearings.size(), " bearings and ", view.ranges.size(), " ranges of ",
      view.descriptors.size(), " features");
  places_.push_back({keyframe, std::move(view)});
}

std::vector<LoopCandidate> VisualPlaces::Propose(size_t end) {
  if (places_.empty()) return {};
  const Place& newest = places_.back();
  std::vector<std::pair<float, size_t>> similar;  // place
  for (size_t i = 0; i + 1 < places_.size() && places_[i].keyframe < end; ++i) {
    const float similarity = Similarity(places_[i].view.global, newest.view.global);
    if (similarity >= static_cast<float>(options_.min_similarity)) {
      similar.emplace_back(similarity, i);
    }
  }
  std::stable_sort(similar.begin(), similar.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  if (similar.size() > static_cast<size_t>(options_.max_places)) {
    similar.resize(static_cast<size_t>(options_.max_places));
  }
  std::vector<LoopCandidate> candidates;
  for (const auto& [similarity, index] : similar) {
    const std::optional<SE3> T_old_new = RelativePose(places_[index].view, newest.view);
    if (!T_old_new) continue;
    LoopCandidate candidate;
    candidate.old_keyframe = places_[index].keyframe;
    candidate.guess.T_target_query = T_body_camera_ * *T_old_new * T_body_camera_.Inverse();
    candidate.guess.position_radius = options_.position_doubt;
    candidate.guess.yaw_radius = options_.yaw_doubt;
    candidate.cost = 1.0 - similarity;
    candidates.push_back(candidate);
  }
  return candidates;
}

std::optional<SE3> VisualPlaces::RelativePose(const PlaceView& old_view,
                                              const PlaceView& new_view) {
  std::vector<FeatureMatch> matches;
  matcher_.Match(old_view.descriptors, new_view.descriptors, &matches);
  std::vector<cv::Point3d> points;  // m, old camera
  std::vector<cv::Point2d> rays;    // new camera, at unit depth
  for (const FeatureMatch& match : matches) {
    const auto first = static_cast<size_t>(match.first);
    const Eigen::Vector3d& ray = new_view.bearings[static_cast<size_t>(match.second)];
    if (old_view.ranges[first] <= 0.0 || ray.z() <= 0.0) continue;
    const Eigen::Vector3d point = old_view.ranges[first] * old_view.bearings[first];
    points.emplace_back(point.x(), point.y(), point.z());
    rays.emplace_back(ray.x() / ray.z(), ray.y() / ray.z());
  }
  if (points.size() < static_cast<size_t>(options_.min_inliers)) return std::nullopt;
  cv::Vec3d rotation;
  cv::Vec3d translation;
  std::vector<int> inliers;
  const bool found =
      cv::solvePnPRansac(points, rays, cv::Matx33d::eye(), cv::noArray(), rotation, translation,
                         false, options_.iterations, static_cast<float>(options_.angle_error),
                         kConfidence, inliers, cv::SOLVEPNP_EPNP);
  if (!found || inliers.size() < static_cast<size_t>(options_.min_inliers)) return std::nullopt;
  const SE3 T_new_old(ExpSo3({rotation[0], rotation[1], rotation[2]}),
                      {translation[0], translation[1], translation[2]});
  return T_new_old.Inverse();
}

}  // namespace regolith
