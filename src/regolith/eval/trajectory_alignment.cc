// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/trajectory_alignment.h"

#include <cmath>
#include <vector>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

std::vector<Eigen::Vector3d> Positions(Span<const StampedPose> poses) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(poses.size());
  for (const StampedPose& pose : poses) positions.push_back(pose.T_world_body.translation);
  return positions;
}

Eigen::Vector3d Mean(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Translation and rotation about z of least squared error: what gravity leaves unknown (Zhang,
/// Scaramuzza 2018, "A tutorial on quantitative trajectory evaluation", eq. 26 to 28).
std::optional<Alignment> AlignYaw(const std::vector<Eigen::Vector3d>& target,
                                  const std::vector<Eigen::Vector3d>& source) {
  const Eigen::Vector3d target_mean = Mean(target);
  const Eigen::Vector3d source_mean = Mean(source);
  double cosine = 0.0;
  double sine = 0.0;
  double size = 0.0;
  for (size_t i = 0; i < source.size(); ++i) {
    const Eigen::Vector2d from = (source[i] - source_mean).head<2>();
    const Eigen::Vector2d to = (target[i] - target_mean).head<2>();
    cosine += from.dot(to);
    sine += from.x() * to.y() - from.y() * to.x();
    size += from.norm() * to.norm();
  }
  if (!(std::hypot(cosine, sine) > 1e-9 * size) || !(size > 0.0)) return std::nullopt;
  Alignment alignment;
  alignment.T_target_source.rotation = ExpSo3({0.0, 0.0, std::atan2(sine, cosine)});
  alignment.T_target_source.translation =
      target_mean - alignment.T_target_source.rotation * source_mean;
  return alignment;
}

}  // namespace

std::optional<Alignment> AlignTrajectory(Span<const StampedPose> reference,
                                         Span<const StampedPose> estimate, AlignmentMode mode) {
  REGOLITH_CHECK(reference.size() == estimate.size() && !reference.empty(), reference.size(),
                 " and ", estimate.size(), " poses");
  switch (mode) {
    case AlignmentMode::kNone:
      return Alignment();
    case AlignmentMode::kOrigin: {
      Alignment alignment;
      alignment.T_target_source =
          reference.front().T_world_body * estimate.front().T_world_body.Inverse();
      return alignment;
    }
    case AlignmentMode::kYaw:
      return AlignYaw(Positions(reference), Positions(estimate));
    case AlignmentMode::kSe3:
    case AlignmentMode::kSim3:
      break;
  }
  return AlignPoints(Positions(estimate), Positions(reference), mode == AlignmentMode::kSim3);
}

std::optional<double> FitScale(Span<const StampedPose> reference,
                               Span<const StampedPose> estimate) {
  const auto alignment = AlignTrajectory(reference, estimate, AlignmentMode::kSim3);
  return alignment ? std::optional<double>(alignment->scale) : std::nullopt;
}

}  // namespace regolith
