// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/rover_shadow.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

constexpr int kSunRays = 5;
constexpr float kGoldenAngle = 2.3999632F;  // rad

}  // namespace

RoverShadow::RoverShadow(const std::vector<RoverBox>& body, const SE3& T_world_base) {
  for (const RoverBox& part : body) {
    const SE3 T_world_box = T_world_base * part.T_base_box;
    Box box;
    box.R_box_world = T_world_box.rotation.toRotationMatrix().transpose().cast<float>();
    box.centre = T_world_box.translation.cast<float>();
    box.half = part.half_size.cast<float>();
    centre_ += box.centre / static_cast<float>(body.size());
    boxes_.push_back(box);
  }
  for (const Box& box : boxes_) {
    radius_ = std::max(radius_, (box.centre - centre_).norm() + box.half.norm());
  }
}

bool RoverShadow::Hides(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  const Eigen::Vector3f to_centre = centre_ - origin;
  const float ahead = to_centre.dot(direction);
  if (to_centre.squaredNorm() - ahead * ahead > radius_ * radius_ || ahead < -radius_) return false;
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
    // Slabs (Kay & Kajiya 1986).
    const Eigen::Vector3f from = box.R_box_world * (origin - box.centre);
    const Eigen::Vector3f along = box.R_box_world * direction;
    float enter = 0.0F;
    float leave = 1e9F;
    for (int axis = 0; axis < 3; ++axis) {
      const float inverse = 1.0F / (std::abs(along[axis]) > 1e-9F ? along[axis] : 1e-9F);
      const float one = (-box.half[axis] - from[axis]) * inverse;
      const float other = (box.half[axis] - from[axis]) * inverse;
      enter = std::max(enter, std::min(one, other));
      leave = std::min(leave, std::max(one, other));
    }
    return enter < leave;
  });
}

float RoverShadow::Sunlit(const Eigen::Vector3f& place, const SunDisc& sun) const {
  const Eigen::Vector3f to_centre = centre_ - place;
  const float ahead = to_centre.dot(sun.direction);
  const float reach = radius_ + sun.radius * std::max(ahead, 0.0F);
  if (ahead < -radius_ || to_centre.squaredNorm() - ahead * ahead > reach * reach) return 1.0F;
  const Eigen::Vector3f across = sun.direction.unitOrthogonal();
  const Eigen::Vector3f along = sun.direction.cross(across);
  int seen = 0;
  for (int ray = 0; ray < kSunRays; ++ray) {
    const float radius = sun.radius * std::sqrt((static_cast<float>(ray) + 0.5F) / kSunRays);
    const float angle = kGoldenAngle * static_cast<float>(ray);
    const Eigen::Vector3f offset = radius * (std::cos(angle) * across + std::sin(angle) * along);
    seen += Hides(place, (sun.direction + offset).normalized()) ? 0 : 1;
  }
  return static_cast<float>(seen) / kSunRays;
}

}  // namespace regolith
