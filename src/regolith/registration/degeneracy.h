// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/geometry/se3.h"
#include "regolith/registration/point_to_plane.h"

namespace regolith {

/// What of a scan's information is more than noise.
struct ObservableSystem {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  int degenerate_directions = 0;  ///< of six
  /// Information over noise in the direction where that is least, and this direction's change of
  /// position (unit, map frame; zero where it is a rotation alone).
  double weakest_ratio = 0.0;
  Eigen::Vector3d weakest_position = Eigen::Vector3d::Zero();
};

/// Splits a system along the directions v in which information and noise are both diagonal
/// (information v = ratio · noise v). On ground without shape the normals differ by their errors
/// alone, and the ratio is 1: nothing is known there, though the information matrix is regular (the
/// effect that Zhang, Kaess, Singh 2016 meet by a threshold on its eigenvalues). Directions whose
/// ratio is below `min_ratio` are taken out, of the others the noise.
ObservableSystem RemoveDegenerateDirections(const PointToPlaneSystem& system, double min_ratio);

/// The covariance of what the scan alone observed; zero along the degenerate directions.
Matrix6d ObservedCovariance(const ObservableSystem& system);

}  // namespace regolith
