// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/sim/drive_map.h"

namespace regolith {

/// A leg to be found, m and rad, frame `map`.
struct LegRequest {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  double arrival_yaw = 0.0;              ///< of the leg before; turning away from it costs
  double turn = 0.0;                     ///< wanted between arrival and this leg's first heading
  std::vector<Eigen::Vector2d> nominal;  ///< what it is to follow, points about 0.5 m apart
  double corridor = 5.0;                 ///< on either side of `nominal`
  double curvature = 0.2;                ///< 1/m, the sharpest
};

/// Points of a leg kLegStep apart, of bounded curvature, from the request's start to within
/// kGoalRadius of the nominal end: the cheapest way by rocks under the wheels, slope, distance
/// from `nominal` and length. Empty where there is none. A* over place and heading (hybrid A*,
/// Dolgov et al. 2010).
std::optional<std::vector<Eigen::Vector2d>> FindLeg(const LegRequest& request, DriveMap* map);

inline constexpr double kLegStep = 0.5;     ///< m
inline constexpr double kGoalRadius = 0.6;  ///< m

/// A smooth curve (twice continuously differentiable) along the points of a leg: a uniform cubic
/// B-spline that begins and ends in the first and last point.
class LegCurve {
 public:
  explicit LegCurve(std::vector<Eigen::Vector2d> points);

  double length() const { return lengths_.back(); }

  struct Sample {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    double yaw = 0.0;        ///< rad, of the tangent, within a turn of 0
    double curvature = 0.0;  ///< 1/m
  };
  /// At `distance` m of arc from the start.
  Sample At(double distance) const;

 private:
  Sample AtParameter(double parameter) const;

  std::vector<Eigen::Vector2d> controls_;
  std::vector<double> lengths_;  ///< m of arc at parameters kParameterStep apart
};

}  // namespace regolith
