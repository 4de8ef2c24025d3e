// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/geometry/se3.h"

namespace regolith {

/// The line of the map that an edge point was matched to.
struct FeatureLine {
  bool valid = false;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       ///< m, on the line, target frame
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit
};

/// The plane of the map that a planar point was matched to.
struct FeaturePlane {
  bool valid = false;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< m, in the plane, target frame
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit
};

/// Points of a scan (m, source frame) and what they were matched to, one for one.
struct FeatureMatches {
  std::vector<Eigen::Vector3d> edges;
  std::vector<FeatureLine> lines;
  std::vector<Eigen::Vector3d> planars;
  std::vector<FeaturePlane> planes;
};

/// The quadratic form of the squared distances (m²) around a pose, with δ as in Plus(T, δ).
struct FeatureSystem {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double cost = 0.0;     ///< half the sum of the robust squared distances, m²
  int matches = 0;       ///< points with a line or plane
  double inliers = 0.0;  ///< sum of the robust weights
};

/// Robust standard deviation of the matches' distances, m, at least `floor`.
double RobustScale(const FeatureMatches& matches, const SE3& T_target_source, double floor);

/// Linearises the distances of edges from their lines and planars from their planes (Zhang & Singh
/// 2014, eq. 2 and 3), with Geman–McClure weights of width `kernel` (m). All distances count the
/// same: the system is in m², not divided by a variance.
FeatureSystem Linearize(const FeatureMatches& matches, const SE3& T_target_source, double kernel);

/// m; an error of rotation weighs as the way of a point this far off.
inline constexpr double kTypicalRange = 10.0;

/// A subspace of small motions in which a pose may move, as the orthogonal projection onto it.
/// Rotations are measured by the way of a point at the distance `length` (m), so that both halves
/// of a tangent vector are lengths.
struct MotionSubspace {
  Matrix6d projection = Matrix6d::Identity();
  double length = 1.0;
};

/// The motions within `subspace` that the system determines: eigen-directions of its information, a
/// match on average, of at least `min_eigenvalue` (Zhang et al. 2016, algorithm 1: the others are
/// left to the guess). 1/3 is the mean over three directions of planes that face everywhere.
/// `removed` counts the directions taken away.
MotionSubspace RemoveDegenerate(const FeatureSystem& system, const MotionSubspace& subspace,
                                double min_eigenvalue, int* removed);

/// Levenberg–Marquardt with the matches held: `steps` attempts, each kept if it lowers the cost.
SE3 MinimizeDistances(const FeatureMatches& matches, const SE3& T_target_source,
                      const MotionSubspace& subspace, double kernel, int steps);

}  // namespace regolith
