// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/cluster_segmentation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "regolith/core/check.h"

namespace regolith {
namespace {

// Cells without a return between two of one thing.
constexpr int kReach = 2;

class ClusterGrower {
 public:
  ClusterGrower(const LidarScan& scan, const RingImage& image,
                const ClusterSegmentationOptions& options, PointLabels* labels)
      : scan_(scan),
        image_(image),
        options_(options),
        tangent_(static_cast<float>(std::tan(options.min_angle_deg * 3.14159265358979 / 180.0))),
        labels_(*labels),
        visited_(image.indices.size(), false) {}

  void Grow() {
    for (int row = 0; row < image_.rows; ++row) {
      for (int column = 0; column < image_.columns; ++column) {
        if (!IsOpen({row, column})) continue;
        Collect({row, column});
        if (!IsLarge()) continue;
        for (const Cell& cell : cluster_) labels_[PointIndex(cell)] = PointLabel::kCluster;
      }
    }
  }

 private:
  struct Cell {
    int row = 0;
    int column = 0;
  };

  size_t PointIndex(Cell cell) const {
    return static_cast<size_t>(image_.Index(cell.row, cell.column));
  }

  bool IsOpen(Cell cell) const {
    return image_.Index(cell.row, cell.column) != RingImage::kEmpty &&
           !visited_[image_.Cell(cell.row, cell.column)] &&
           labels_[PointIndex(cell)] != PointLabel::kGround;
  }

  /// Fills `cluster_` with all that is connected to `first`.
  void Collect(Cell first) {
    cluster_.clear();
    Visit(first);
    for (size_t next = 0; next < cluster_.size(); ++next) {
      const Cell cell = cluster_[next];
      for (const int direction : {1, -1}) {
        const auto beside = image_.Next(cell.row, cell.column, direction, kReach);
        if (beside) Connect(cell, {cell.row, *beside});
        const int row = cell.row + direction;
        if (row < 0 || row >= image_.rows) continue;
        if (const auto column = image_.Near(row, cell.column)) Connect(cell, {row, *column});
      }
    }
  }

  void Connect(Cell from, Cell to) {
    if (IsOpen(to) && AreOneThing(from, to)) Visit(to);
  }

  void Visit(Cell cell) {
    visited_[image_.Cell(cell.row, cell.column)] = true;
    cluster_.push_back(cell);
  }

  /// tan β = d₂ sin α / (d₁ - d₂ cos α), with d₁ the longer range and α the angle between the beams
  /// (Bogoslavskyi & Stachniss 2016, eq. 1).
  bool AreOneThing(Cell first, Cell second) const {
    const Eigen::Vector3f& one = scan_.points[PointIndex(first)].position;
    const Eigen::Vector3f& other = scan_.points[PointIndex(second)].position;
    const float longer = std::max(image_.ranges[image_.Cell(first.row, first.column)],
                                  image_.ranges[image_.Cell(second.row, second.column)]);
    // Both times the longer range: d₁ d₂ sin α and d₁² - d₁ d₂ cos α.
    const float across = one.cross(other).norm();
    const float along = longer * longer - one.dot(other);
    return across > tangent_ * along;
  }

  bool IsLarge() const {
    const auto count = static_cast<int>(cluster_.size());
    if (count >= options_.min_points) return true;
    if (count < options_.min_points_across) return false;
    const auto [low, high] =
        std::minmax_element(cluster_.begin(), cluster_.end(),
                            [](const Cell& one, const Cell& other) { return one.row < other.row; });
    return high->row - low->row + 1 >= options_.min_rings;
  }

  const LidarScan& scan_;
  const RingImage& image_;
  ClusterSegmentationOptions options_;
  float tangent_;
  PointLabels& labels_;
  std::vector<bool> visited_;
  std::vector<Cell> cluster_;
};

}  // namespace

void ClusterSegmentationOptions::Check() const {
  REGOLITH_CHECK(min_angle_deg > 0.0 && min_angle_deg < 90.0, "min_angle_deg=", min_angle_deg);
  REGOLITH_CHECK(min_points > 0, "min_points=", min_points);
  REGOLITH_CHECK(min_points_across > 0, "min_points_across=", min_points_across);
  REGOLITH_CHECK(min_rings > 0, "min_rings=", min_rings);
}

void SegmentClusters(const LidarScan& scan, const RingImage& image,
                     const ClusterSegmentationOptions& options, PointLabels* labels) {
  REGOLITH_CHECK(labels->size() == scan.points.size(), labels->size(), " labels for ",
                 scan.points.size(), " points");
  ClusterGrower(scan, image, options, labels).Grow();
}

}  // namespace regolith
