// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/landmark_aligner.h"

#include <cmath>

#include <Eigen/LU>

namespace regolith {
namespace {

constexpr float kNeighbourhood = 60.0F;  // pixels
constexpr int kLeastNeighbours = 6;
constexpr float kSmoothing = 100.0F;  // pixels², so that neighbours in a line say nothing across it
constexpr double kNearest = 0.1;      // m
constexpr double kLeastArea = 1e-3;   // of a pixel, seen from elsewhere

}  // namespace

std::vector<Eigen::Vector2f> DisparitySlopes(const StereoFeatures& features) {
  std::vector<Eigen::Vector2f> slopes(features.size(), Eigen::Vector2f::Zero());
  std::vector<size_t> known;
  for (size_t i = 0; i < features.size(); ++i) {
    if (features.HasRight(i)) known.push_back(i);
  }
  for (size_t i = 0; i < features.size(); ++i) {
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();  // offset, disparity
    Eigen::Matrix3f products = Eigen::Matrix3f::Zero();
    int count = 0;
    for (const size_t other : known) {
      const Eigen::Vector2f offset = features.pixels[other] - features.pixels[i];
      if (std::abs(offset.x()) > kNeighbourhood || std::abs(offset.y()) > kNeighbourhood) continue;
      const Eigen::Vector3f row(offset.x(), offset.y(),
                                features.pixels[other].x() - features.right_columns[other]);
      mean += row;
      products += row * row.transpose();
      ++count;
    }
    if (count < kLeastNeighbours) continue;
    mean /= static_cast<float>(count);
    const Eigen::Matrix3f covariance =
        products / static_cast<float>(count) - mean * mean.transpose();
    Eigen::Matrix2f spread = covariance.topLeftCorner<2, 2>();
    spread.diagonal().array() += kSmoothing;
    slopes[i] = spread.inverse() * covariance.topRightCorner<2, 1>();
  }
  return slopes;
}

void MovePlace(const Eigen::Vector2f& place, const Eigen::Vector2f& slope, size_t row,
               StereoFeatures* features) {
  if (features->HasRight(row)) {
    const Eigen::Vector2f before = features->pixels[row] - place;
    const float disparity = features->pixels[row].x() - features->right_columns[row];
    features->right_columns[row] = place.x() - (disparity - slope.dot(before));
  }
  features->pixels[row] = place;
}

bool LandmarkAligner::Align(const StereoKeyframe& from, size_t from_row,
                            const Eigen::Vector3d& point_world, const SE3& T_world_camera,
                            StereoFeatures* features, size_t row) const {
  if (features->patches.empty() || from.features.patches.empty()) return true;
  const double depth = (from.T_world_camera.Inverse() * point_world).z();
  if (depth < kNearest) return false;
  const double product = camera_.focal * camera_.baseline;
  const Eigen::Vector2d from_pixel = from.features.pixels[from_row].cast<double>();
  const Eigen::Vector2d slope = from.features.slopes[from_row].cast<double>();
  const SE3 T_camera_from = T_world_camera.Inverse() * from.T_world_camera;
  // On the plane of the ground around it.
  const auto seen = [&](const Eigen::Vector2d& offset) -> Eigen::Vector3d {
    const double disparity = std::max(product / depth + slope.dot(offset), 0.1 * product / depth);
    return camera_.Project(T_camera_from *
                           camera_.PointAt(from_pixel + offset, camera_.Depth(disparity)));
  };
  Eigen::Matrix<double, 3, 2> by_from;
  by_from << 0.5 * (seen({1.0, 0.0}) - seen({-1.0, 0.0})),
      0.5 * (seen({0.0, 1.0}) - seen({0.0, -1.0}));
  const Eigen::Matrix2d pixel_by_from = by_from.topRows<2>();
  if (std::abs(pixel_by_from.determinant()) < kLeastArea) return false;
  const Eigen::Matrix2d from_by_pixel = pixel_by_from.inverse();
  const auto place =
      AlignPatch(from.features.patches[from_row], from.features.pixels[from_row],
                 features->patches[row], features->pixels[row], from_by_pixel.cast<float>(),
                 options_.min_correlation, options_.max_step);
  if (!place) return false;
  const Eigen::RowVector2d disparity_by_from = by_from.row(0) - by_from.row(2);
  MovePlace(*place, (disparity_by_from * from_by_pixel).transpose().cast<float>(), row, features);
  return true;
}

bool LandmarkAligner::Align(const StereoMap& map, const StereoLandmark& landmark,
                            const SE3& T_world_camera, StereoFeatures* features, size_t row) const {
  const StereoSighting& newest = landmark.sightings.back();
  return Align(map.keyframe(newest.keyframe), static_cast<size_t>(newest.feature),
               landmark.position_world, T_world_camera, features, row);
}

}  // namespace regolith
