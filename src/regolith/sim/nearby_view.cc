// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/nearby_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regolith/core/check.h"

namespace regolith {
namespace {

// Neighbouring pixels of one surface differ less than this in distance, and by metre of it.
constexpr float kToleranceAcross = 0.02F;
constexpr float kToleranceDown = 0.03F;
constexpr float kToleranceByMetre = 0.01F;
constexpr int kMargin = 2;     // pixels around an edge
constexpr int kMostSteps = 5;  // towards the place where two rays meet
constexpr float kMet = 2e-4F;  // of the distance

}  // namespace

bool SeeOneSurface(const Scene& scene, const RayEnd& one, const RayEnd& other, float tolerance) {
  if (one.object == kNothing || other.object == kNothing) return one.object == other.object;
  if (scene.IsRock(one.object) || scene.IsRock(other.object)) return false;
  const float nearer = std::min(one.distance, other.distance);
  return std::abs(one.distance - other.distance) <= tolerance * nearer;
}

NearbyView::NearbyView(const RenderedView& view, const SE3& T_world_camera,
                       const CameraIntrinsics& intrinsics, double baseline, const Scene& scene)
    : view_(view),
      scene_(scene),
      R_camera_world_(T_world_camera.rotation.conjugate().toRotationMatrix().cast<float>()),
      origin_(T_world_camera.translation.cast<float>()),
      focal_(intrinsics.focal.cast<float>()),
      principal_point_(intrinsics.principal_point.cast<float>()),
      parallax_(static_cast<float>(baseline * intrinsics.focal.x())),
      broken_(view.distance.size(), 0) {
  REGOLITH_CHECK(intrinsics.model == CameraModelType::kPinhole, "a camera of another model");
  std::transform(intrinsics.distortion.begin(), intrinsics.distortion.end(), distortion_.begin(),
                 [](double value) { return static_cast<float>(value); });
  MarkEdges();
}

// An edge hides as many pixels from another camera as its sides' parallaxes differ.
void NearbyView::MarkEdge(const RayEnd& one, const RayEnd& other, int column, int row) {
  const float jump = std::abs(1.0F / one.distance - 1.0F / other.distance);
  const int reach = kMargin + static_cast<int>(std::ceil(std::min(parallax_ * jump, 100.0F)));
  const int first = std::max(column - reach, 0);
  const int last = std::min(column + reach, view_.width - 1);
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, view_.height - 1); ++r) {
    std::fill(broken_.begin() + static_cast<std::ptrdiff_t>(view_.Index(first, r)),
              broken_.begin() + static_cast<std::ptrdiff_t>(view_.Index(last, r)) + 1, char{1});
  }
}

void NearbyView::MarkEdges() {
  const auto check = [&](const RayEnd& here, int column, int row, const RayEnd& there,
                         float tolerance) {
    const float nearer = std::min(here.distance, there.distance);
    if (SeeOneSurface(scene_, here, there, tolerance + kToleranceByMetre * nearer)) return;
    MarkEdge(here, there, column, row);
  };
  for (int row = 0; row < view_.height; ++row) {
    for (int column = 0; column < view_.width; ++column) {
      const RayEnd here = view_.End(column, row);
      if (column + 1 < view_.width) {
        check(here, column, row, view_.End(column + 1, row), kToleranceAcross);
      }
      if (row + 1 < view_.height) {
        check(here, column, row, view_.End(column, row + 1), kToleranceDown);
      }
    }
  }
}

// The pixel of a point, as CameraModel::Project in single precision, where four pixels around it
// see unbroken ground.
std::optional<NearbyView::Place> NearbyView::See(const Eigen::Vector3f& point_world) const {
  const Eigen::Vector3f point = R_camera_world_ * (point_world - origin_);
  if (point.z() < 0.1F) return std::nullopt;
  const float x = point.x() / point.z();
  const float y = point.y() / point.z();
  const float square = x * x + y * y;
  const float radial = 1.0F + square * (distortion_[0] + square * distortion_[1]);
  const float p1 = distortion_[2];
  const float p2 = distortion_[3];
  Place place;
  place.pixel.x() = focal_.x() * (x * radial + 2.0F * p1 * x * y + p2 * (square + 2.0F * x * x)) +
                    principal_point_.x();
  place.pixel.y() = focal_.y() * (y * radial + p1 * (square + 2.0F * y * y) + 2.0F * p2 * x * y) +
                    principal_point_.y();
  if (!(place.pixel.x() >= 0.0F && place.pixel.y() >= 0.0F &&
        place.pixel.x() < static_cast<float>(view_.width - 1) &&
        place.pixel.y() < static_cast<float>(view_.height - 1))) {
    return std::nullopt;
  }
  const size_t nearest = view_.Index(static_cast<int>(place.pixel.x() + 0.5F),
                                     static_cast<int>(place.pixel.y() + 0.5F));
  if (broken_[nearest] != 0 || view_.objects[nearest] == kNothing) return std::nullopt;
  place.distance = point.norm();
  return place;
}

// What is seen at a pixel: inverse distances are linear between the pixels of a plane.
float NearbyView::Distance(const Eigen::Vector2f& pixel) const {
  const auto column = static_cast<int>(pixel.x());
  const auto row = static_cast<int>(pixel.y());
  const float a = pixel.x() - static_cast<float>(column);
  const float b = pixel.y() - static_cast<float>(row);
  const float* upper = &view_.distance[view_.Index(column, row)];
  const float* lower = upper + view_.width;
  const float inverse = (1.0F - b) * ((1.0F - a) / upper[0] + a / upper[1]) +
                        b * ((1.0F - a) / lower[0] + a / lower[1]);
  return 1.0F / inverse;
}

std::optional<RayEnd> NearbyView::Find(int column, int row, const Eigen::Vector3f& origin,
                                       const Eigen::Vector3f& direction) const {
  const RayEnd there = view_.End(column, row);
  if (there.object == kNothing) {
    if (broken_[view_.Index(column, row)] != 0) return std::nullopt;
    return there;
  }
  float distance = there.distance;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Vector3f point = origin + distance * direction;
    const std::optional<Place> place = See(point);
    if (!place) return std::nullopt;
    const float beyond = Distance(place->pixel) - place->distance;
    if (std::abs(beyond) < kMet * distance) {
      const auto left = static_cast<int>(place->pixel.x());
      const auto top = static_cast<int>(place->pixel.y());
      for (int corner = 0; corner < 4; ++corner) {
        const uint32_t object = view_.objects[view_.Index(left + corner % 2, top + corner / 2)];
        if (scene_.Covers(object, point.x(), point.y())) return RayEnd{distance, object};
      }
      return std::nullopt;
    }
    distance += beyond;
    if (!(distance > 0.1F)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace regolith
