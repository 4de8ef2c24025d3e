// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/stereo_matcher.h"

#include <cmath>

namespace regolith {
namespace {

constexpr double kEpipolarPixels = 2.0;

}  // namespace

StereoMatcher::StereoMatcher(const OpticalFlowOptions& options, const CameraIntrinsics& right,
                             const SE3& T_left_right)
    : flow_(options), right_(CameraModel::Create(right)), T_left_right_(T_left_right) {}

bool StereoMatcher::AgreesWithGeometry(const Eigen::Vector3d& left,
                                       const Eigen::Vector3d& right) const {
  const Eigen::Vector3d turned = T_left_right_.rotation * right;
  const Eigen::Vector3d normal = T_left_right_.translation.cross(left);
  const double limit = kEpipolarPixels / right_->intrinsics().focal.mean();
  if (std::abs(normal.normalized().dot(turned)) > limit) return false;
  // Seen from the right, what is near lies more to the left: along the normal of both planes.
  return normal.dot(turned.cross(left)) <= limit * normal.norm();
}

std::vector<std::optional<Eigen::Vector3d>> StereoMatcher::Match(
    const Image& left, const Image& right, Span<const TrackedFeature> features) {
  flow_.Reset();
  flow_.Advance(left);
  flow_.Advance(right);
  std::vector<Eigen::Vector2f> pixels;
  for (const TrackedFeature& feature : features) pixels.push_back(feature.pixel);
  FlowResult found;
  flow_.Track(pixels, {}, &found);
  std::vector<std::optional<Eigen::Vector3d>> bearings(features.size());
  for (size_t i = 0; i < features.size(); ++i) {
    if (!found.found[i]) continue;
    const auto bearing = right_->Unproject(found.pixels[i].cast<double>());
    if (bearing && AgreesWithGeometry(features[i].bearing, *bearing)) bearings[i] = bearing;
  }
  return bearings;
}

}  // namespace regolith
