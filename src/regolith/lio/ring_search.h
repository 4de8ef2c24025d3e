// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/lio/feature_problem.h"

namespace regolith {

/// A point of a scan and the row of its ring.
struct RingPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, lidar
  int row = 0;
};

/// The features of one scan, searched ring by ring along the azimuth: of the few points a ring and
/// sector that is faster than a tree, and a line or plane needs to know the rings of its points.
class RingSearch {
 public:
  RingSearch() = default;
  explicit RingSearch(std::vector<RingPoint> points);

  /// The line through the nearest point and the nearest one of another ring close by (Zhang & Singh
  /// 2014, figure 7a). `query`: m, lidar frame of the features; both within `max_distance` (m).
  FeatureLine FindLine(const Eigen::Vector3d& query, double max_distance) const;

  /// The plane through the nearest point, another of its ring and one of another ring close by
  /// (figure 7b). All within `max_distance` (m); invalid where they lie nearly on one line.
  FeaturePlane FindPlane(const Eigen::Vector3d& query, double max_distance) const;

 private:
  struct Feature {
    double azimuth = 0.0;  ///< rad
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
  };
  struct Hit {
    int row = 0;
    size_t place = 0;
    double distance = 0.0;  ///< m
  };

  /// Nearest point of the rows first … last but `skipped_row`, or but the one at `skipped`.
  std::optional<Hit> Nearest(const Eigen::Vector3d& query, int first, int last, int skipped_row,
                             const Hit* skipped, double max_distance) const;
  void SearchRow(const Eigen::Vector3d& query, int row, const Hit* skipped, double max_distance,
                 std::optional<Hit>* best) const;
  const Eigen::Vector3d& At(const Hit& hit) const {
    return rows_[static_cast<size_t>(hit.row)][hit.place].position;
  }
  std::optional<Hit> NearestOfOtherRing(const Eigen::Vector3d& query, const Hit& nearest,
                                        double max_distance) const;

  std::vector<std::vector<Feature>> rows_;  ///< by azimuth
};

}  // namespace regolith
