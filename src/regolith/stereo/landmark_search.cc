// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/landmark_search.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

constexpr double kNearest = 0.1;  // m
// A feature of the image itself stands for all that are as small as it or smaller.
constexpr double kLeastScale = 1.0;

DescriptorMatcherOptions MatcherOptions(const LandmarkSearchOptions& options, double ratio) {
  DescriptorMatcherOptions matcher;
  matcher.ratio = ratio;
  matcher.max_hamming = options.max_hamming;
  matcher.min_similarity = options.min_similarity;
  return matcher;
}

}  // namespace

SearchPoint FeatureAsPoint(const StereoFeatures& features, size_t row,
                           const Eigen::Vector3d& predicted, double radius) {
  SearchPoint point;
  point.predicted = predicted;
  point.scale = features.has_scales ? features.scales[row] : 0.0F;
  point.radius = static_cast<float>(radius) * features.scales[row];
  point.descriptors = &features.descriptors;
  point.row = row;
  return point;
}

LandmarkSearch::LandmarkSearch(const LandmarkSearchOptions& options, const RectifiedCamera& camera)
    : options_(options),
      camera_(camera),
      exclusive_(MatcherOptions(options, options.frame_ratio)),
      nearest_(MatcherOptions(options, 1.0)),
      anywhere_(MatcherOptions(options, options.keyframe_ratio)) {
  options_.Check();
}

std::vector<FeatureMatch> LandmarkSearch::ByPlace(const std::vector<SearchPoint>& points,
                                                  const StereoFeatures& features, bool exclusive) {
  std::vector<FeatureMatch> matches;
  if (points.empty()) return matches;
  queries_.ResetLike(features.descriptors);
  guide_.predicted.clear();
  guide_.radii.clear();
  for (const SearchPoint& point : points) {
    queries_.Append(*point.descriptors, point.row);
    guide_.predicted.push_back(point.predicted.head<2>().cast<float>());
    guide_.radii.push_back(point.radius);
  }
  (exclusive ? exclusive_ : nearest_)
      .MatchGuided(queries_, features.descriptors, guide_, features.pixels, &matches);
  const auto ratio = static_cast<float>(options_.max_scale_ratio);
  const auto disagrees = [&](const FeatureMatch& match) {
    const SearchPoint& point = points[static_cast<size_t>(match.first)];
    const auto feature = static_cast<size_t>(match.second);
    const float scale = features.scales[feature];
    if (point.scale > 0.0F && (scale > ratio * point.scale || point.scale > ratio * scale)) {
      return true;
    }
    return features.HasRight(feature) &&
           std::abs(features.right_columns[feature] - point.predicted.z()) > 1.5 * point.radius;
  };
  matches.erase(std::remove_if(matches.begin(), matches.end(), disagrees), matches.end());
  return matches;
}

std::vector<FeatureMatch> LandmarkSearch::Anywhere(const Descriptors& points,
                                                   const Descriptors& features) {
  std::vector<FeatureMatch> matches;
  anywhere_.Match(points, features, &matches);
  return matches;
}

std::optional<SearchPoint> LandmarkSearch::Predict(const StereoMap& map,
                                                   const StereoLandmark& landmark,
                                                   const SE3& T_world_camera, double radius) const {
  const Eigen::Vector3d view = landmark.position_world - T_world_camera.translation;
  const double distance = view.norm();
  if (view.dot(landmark.view_world) < std::cos(options_.max_view_angle) * distance) {
    return std::nullopt;
  }
  const Eigen::Vector3d point = T_world_camera.rotation.conjugate() * view;
  if (point.z() < kNearest) return std::nullopt;
  SearchPoint search;
  search.predicted = camera_.Project(point);
  if (!camera_.Contains(search.predicted.head<2>())) return std::nullopt;
  const StereoFeatures& typical = map.keyframe(landmark.typical.keyframe).features;
  double scale = 1.0;
  if (typical.has_scales) {
    scale = std::max(landmark.scale_distance / distance, kLeastScale);
    search.scale = static_cast<float>(scale);
  }
  search.radius = static_cast<float>(radius * scale);
  search.descriptors = &typical.descriptors;
  search.row = static_cast<size_t>(landmark.typical.feature);
  return search;
}

}  // namespace regolith
