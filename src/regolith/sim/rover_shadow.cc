// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rover_shadow.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

constexpr size_t kSunRays = 5;

}  // namespace

RoverShadow::RoverShadow(const std::vector<RoverBox>& body, const SE3& T_world_base) {
  for (const RoverBox& part : body) {
    const SE3 T_world_box = T_world_base * part.T_base_box;
    Box box;
    box.R_box_world = T_world_box.rotation.toRotationMatrix().transpose().cast<float>();
    box.centre = T_world_box.translation.cast<float>();
    box.half = part.half_size.cast<float>();
    box.radius = box.half.norm();
    centre_ += box.centre / static_cast<float>(body.size());
    boxes_.push_back(box);
  }
  for (const Box& box : boxes_) {
    radius_ = std::max(radius_, (box.centre - centre_).norm() + box.radius);
  }
}

// Slabs (Kay & Kajiya 1986).
bool RoverShadow::Box::Meets(const Eigen::Vector3f& origin,
                             const Eigen::Vector3f& direction) const {
  const Eigen::Vector3f from = R_box_world * (origin - centre);
  const Eigen::Vector3f along = R_box_world * direction;
  float enter = 0.0F;
  float leave = 1e9F;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1.0F / (std::abs(along[axis]) > 1e-9F ? along[axis] : 1e-9F);
    const float one = (-half[axis] - from[axis]) * inverse;
    const float other = (half[axis] - from[axis]) * inverse;
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  return enter < leave;
}

bool RoverShadow::Hides(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  return std::any_of(boxes_.begin(), boxes_.end(),
                     [&](const Box& box) { return box.Meets(origin, direction); });
}

float RoverShadow::Sunlit(const Eigen::Vector3f& place, const SunDisc& sun) const {
  // Whether a sphere may hide a part of the disc.
  const auto may_hide = [&](const Eigen::Vector3f& centre, float radius) {
    const Eigen::Vector3f to_centre = centre - place;
    const float ahead = to_centre.dot(sun.direction);
    const float reach = radius + sun.radius * std::max(ahead, 0.0F);
    return ahead > -radius && to_centre.squaredNorm() - ahead * ahead < reach * reach;
  };
  if (!may_hide(centre_, radius_)) return 1.0F;
  const auto rays = SpreadOverDisc<kSunRays>(sun);
  bool hidden[kSunRays] = {};
  for (const Box& box : boxes_) {
    if (!may_hide(box.centre, box.radius)) continue;
    for (size_t ray = 0; ray < kSunRays; ++ray) {
      hidden[ray] = hidden[ray] || box.Meets(place, rays[ray]);
    }
  }
  return 1.0F - static_cast<float>(std::count(hidden, hidden + kSunRays, true)) / kSunRays;
}

}  // namespace regolith
