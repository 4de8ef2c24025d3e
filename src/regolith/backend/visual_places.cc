// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/visual_places.h"

#include <algorithm>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/features/absolute_pose.h"
#include "regolith/features/global_descriptor.h"
#include "regolith/geometry/so3.h"

namespace regolith {

void VisualPlacesOptions::Check() const {
  matcher.Check();
  REGOLITH_CHECK(matched_places >= 1, "matched_places=", matched_places);
  REGOLITH_CHECK(max_places >= 1, "max_places=", max_places);
  REGOLITH_CHECK(min_inliers >= 6, "min_inliers=", min_inliers);
  REGOLITH_CHECK(angle_error > 0.0, "angle_error=", angle_error);
  REGOLITH_CHECK(iterations >= 1, "iterations=", iterations);
  REGOLITH_CHECK(position_doubt > 0.0 && yaw_doubt > 0.0, "position_doubt=", position_doubt);
  REGOLITH_CHECK(confirmed_inliers >= 6, "confirmed_inliers=", confirmed_inliers);
  for (const double limit :
       {confirmed_position, confirmed_rotation, position_sigma, rotation_sigma}) {
    REGOLITH_CHECK(limit > 0.0, "limit=", limit);
  }
}

VisualPlaces::VisualPlaces(const VisualPlacesOptions& options)
    : options_(options), matcher_(options.matcher) {
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

std::vector<std::pair<float, size_t>> VisualPlaces::MostSimilar(size_t end, double min_similarity,
                                                                int count) const {
  std::vector<std::pair<float, size_t>> similar;
  const Place& newest = places_.back();
  for (size_t i = 0; i + 1 < places_.size() && places_[i].keyframe < end; ++i) {
    const float similarity = Similarity(places_[i].view.global, newest.view.global);
    if (similarity >= static_cast<float>(min_similarity)) similar.emplace_back(similarity, i);
  }
  std::stable_sort(similar.begin(), similar.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  similar.resize(std::min(similar.size(), static_cast<size_t>(count)));
  return similar;
}

// Which of the similar images are of one place is seen by their matches: on explored ground of
// `mars` the right one was among the first nine by its global descriptor, mostly not the first.
std::vector<LoopCandidate> VisualPlaces::Propose(size_t end) {
  if (places_.empty()) return {};
  constexpr double kAnySimilarity = -2.0;
  const PlaceView& newest = places_.back().view;
  std::vector<std::pair<Correspondences, size_t>> matched;
  for (const auto& [similarity, index] :
       MostSimilar(end, kAnySimilarity, options_.matched_places)) {
    Correspondences correspondences = Match(places_[index].view, newest);
    // RANSAC on mere chance matches would be the dearest part of it.
    if (correspondences.points.size() < static_cast<size_t>(2 * options_.min_inliers)) continue;
    matched.emplace_back(std::move(correspondences), index);
  }
  std::stable_sort(matched.begin(), matched.end(), [](const auto& a, const auto& b) {
    return a.first.points.size() > b.first.points.size();
  });
  matched.resize(std::min(matched.size(), static_cast<size_t>(options_.max_places)));
  std::vector<LoopCandidate> candidates;
  for (const auto& [correspondences, index] : matched) {
    const auto T_old_new = RelativeCameraPose(correspondences, options_.min_inliers);
    if (!T_old_new) continue;
    LoopCandidate candidate;
    candidate.source = LoopSource::kImages;
    candidate.old_keyframe = places_[index].keyframe;
    candidate.guess.T_target_query =
        places_[index].view.T_body_camera * *T_old_new * newest.T_body_camera.Inverse();
    candidate.guess.position_radius = options_.position_doubt;
    candidate.guess.yaw_radius = options_.yaw_doubt;
    candidates.push_back(candidate);
  }
  return candidates;
}

std::vector<LoopMeasurement> VisualPlaces::Confirmed(size_t end) {
  if (places_.empty()) return {};
  const Place& newest = places_.back();
  std::vector<LoopMeasurement> loops;
  for (const auto& [similarity, index] :
       MostSimilar(end, options_.min_similarity, options_.max_places)) {
    const PlaceView& old_view = places_[index].view;
    const auto T_old_new =
        RelativeCameraPose(Match(old_view, newest.view), options_.confirmed_inliers);
    if (!T_old_new) continue;
    const auto T_new_old =
        RelativeCameraPose(Match(newest.view, old_view), options_.confirmed_inliers);
    if (!T_new_old) continue;
    const SE3 back = T_new_old->Inverse();
    const SE3 difference = T_old_new->Inverse() * back;
    if (difference.translation.norm() > options_.confirmed_position ||
        LogSo3(difference.rotation).norm() > options_.confirmed_rotation) {
      continue;
    }
    LoopMeasurement loop;
    loop.old_keyframe = places_[index].keyframe;
    loop.new_keyframe = newest.keyframe;
    loop.T_old_new.T_a_b = old_view.T_body_camera * Interpolate(*T_old_new, back, 0.5) *
                           newest.view.T_body_camera.Inverse();
    loop.T_old_new.covariance.diagonal().head<3>().setConstant(options_.rotation_sigma *
                                                               options_.rotation_sigma);
    loop.T_old_new.covariance.diagonal().tail<3>().setConstant(options_.position_sigma *
                                                               options_.position_sigma);
    loops.push_back(loop);
  }
  return loops;
}

VisualPlaces::Correspondences VisualPlaces::Match(const PlaceView& old_view,
                                                  const PlaceView& new_view) {
  std::vector<FeatureMatch> matches;
  matcher_.Match(old_view.descriptors, new_view.descriptors, &matches);
  Correspondences correspondences;
  for (const FeatureMatch& match : matches) {
    const auto first = static_cast<size_t>(match.first);
    if (old_view.ranges[first] <= 0.0) continue;
    correspondences.points.push_back(old_view.ranges[first] * old_view.bearings[first]);
    correspondences.bearings.push_back(new_view.bearings[static_cast<size_t>(match.second)]);
  }
  return correspondences;
}

std::optional<SE3> VisualPlaces::RelativeCameraPose(const Correspondences& correspondences,
                                                    int min_inliers) const {
  AbsolutePoseOptions ransac;
  ransac.iterations = options_.iterations;
  ransac.angle_error = options_.angle_error;
  ransac.min_inliers = min_inliers;
  const auto pose = EstimateAbsolutePose(correspondences.points, correspondences.bearings, ransac);
  if (!pose) return std::nullopt;
  return pose->T_camera_points.Inverse();
}

}  // namespace regolith
