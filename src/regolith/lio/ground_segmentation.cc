// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/ground_segmentation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr float kRadian = 3.14159265F / 180.0F;
constexpr float kNoSlope = std::numeric_limits<float>::quiet_NaN();
// A beam that meets nothing leaves a gap; ground goes on across this many cells.
constexpr int kReach = 2;
// Ground begins below the lidar, in one of the lowest rings that return at all.
constexpr int kSeedRings = 3;

/// Grows the ground over the image. A cell's slope is that of the stretch from it to the cell above
/// it in its column, radians off the rover's level, positive where ground rises outwards.
class GroundGrower {
 public:
  GroundGrower(const LidarScan& scan, const RingImage& image, const Eigen::Vector3d& up_lidar,
               const GroundSegmentationOptions& options)
      : scan_(scan),
        image_(image),
        up_(up_lidar.cast<float>()),
        seed_slope_(static_cast<float>(options.seed_slope_deg) * kRadian),
        max_slope_(static_cast<float>(options.max_slope_deg) * kRadian),
        max_bend_(static_cast<float>(options.max_bend_deg) * kRadian),
        max_step_(static_cast<float>(options.max_step)),
        slopes_(image.indices.size(), kNoSlope),
        ground_(image.indices.size(), false) {}

  PointLabels Grow() {
    for (int row = 0; row + 1 < image_.rows; ++row) {
      for (int column = 0; column < image_.columns; ++column) Measure(row, column);
    }
    for (int column = 0; column < image_.columns; ++column) Seed(column);
    while (!open_.empty()) {
      const GroundCell ground = open_.back();
      open_.pop_back();
      GrowUp(ground);
      GrowAlong(ground, 1);
      GrowAlong(ground, -1);
    }
    PointLabels labels(scan_.points.size(), PointLabel::kNone);
    for (size_t cell = 0; cell < ground_.size(); ++cell) {
      if (ground_[cell]) labels[static_cast<size_t>(image_.indices[cell])] = PointLabel::kGround;
    }
    return labels;
  }

 private:
  struct Cell {
    int row = 0;
    int column = 0;
  };
  struct GroundCell {
    Cell cell;
    float slope = 0.0F;  ///< of the ground on the way to it
  };

  const Eigen::Vector3f& Point(Cell cell) const {
    return scan_.points[static_cast<size_t>(image_.Index(cell.row, cell.column))].position;
  }
  float& SlopeOf(Cell cell) { return slopes_[image_.Cell(cell.row, cell.column)]; }
  bool IsGround(const Cell& cell) const { return ground_[image_.Cell(cell.row, cell.column)]; }

  /// The cell above in the same column: of the next ring, or of the one after it where that has no
  /// point there.
  std::optional<Cell> Above(Cell cell) const {
    for (int row = cell.row + 1; row <= std::min(cell.row + kReach, image_.rows - 1); ++row) {
      if (const auto column = image_.Near(row, cell.column)) return Cell{row, *column};
    }
    return std::nullopt;
  }

  void Measure(int row, int column) {
    const Cell cell{row, column};
    if (image_.Index(row, column) == RingImage::kEmpty) return;
    const auto above = Above(cell);
    if (!above) return;
    const Eigen::Vector3f& point = Point(cell);
    const Eigen::Vector3f stretch = Point(*above) - point;
    const float rise = stretch.dot(up_);
    const float run = (stretch - rise * up_).norm();
    // Outwards is where the beam goes; what comes back towards the lidar overhangs and is steep.
    const float outwards = stretch.dot(point - point.dot(up_) * up_);
    SlopeOf(cell) = std::atan2(rise, outwards >= 0.0F ? run : -run);
  }

  void Seed(int column) {
    int tried = 0;
    for (int row = 0; row < image_.rows && tried < kSeedRings; ++row) {
      const Cell cell{row, column};
      if (image_.Index(row, column) == RingImage::kEmpty) continue;
      ++tried;
      if (Point(cell).dot(up_) < 0.0F && std::abs(SlopeOf(cell)) < seed_slope_) {
        Accept(cell, SlopeOf(cell));
        return;
      }
    }
  }

  /// `slope`: of the ground on the way to the cell.
  void Accept(Cell cell, float slope) {
    if (IsGround(cell)) return;
    ground_[image_.Cell(cell.row, cell.column)] = true;
    open_.push_back({cell, slope});
  }

  bool Continues(float slope, float next) const {
    return std::abs(next) < max_slope_ && std::abs(next - slope) < max_bend_;
  }

  void GrowUp(const GroundCell& ground) {
    const float next = SlopeOf(ground.cell);
    if (!Continues(ground.slope, next)) return;
    if (const auto above = Above(ground.cell)) Accept(*above, next);
  }

  /// Along a ring: no step in range, and the ground goes on upwards of there as it did below.
  void GrowAlong(const GroundCell& ground, int direction) {
    const Cell cell = ground.cell;
    const auto column = image_.Next(cell.row, cell.column, direction, kReach);
    if (!column) return;
    const Cell beside{cell.row, *column};
    const float range = image_.ranges[image_.Cell(cell.row, cell.column)];
    const float step = image_.ranges[image_.Cell(beside.row, beside.column)] - range;
    if (std::abs(step) > max_step_ * range) return;
    if (Continues(ground.slope, SlopeOf(beside))) Accept(beside, ground.slope);
  }

  const LidarScan& scan_;
  const RingImage& image_;
  Eigen::Vector3f up_;
  float seed_slope_;
  float max_slope_;
  float max_bend_;
  float max_step_;
  std::vector<float> slopes_;
  std::vector<bool> ground_;
  std::vector<GroundCell> open_;
};

}  // namespace

void GroundSegmentationOptions::Check() const {
  REGOLITH_CHECK(seed_slope_deg > 0.0 && seed_slope_deg < 90.0, "seed_slope_deg=", seed_slope_deg);
  REGOLITH_CHECK(max_slope_deg > 0.0 && max_slope_deg < 90.0, "max_slope_deg=", max_slope_deg);
  REGOLITH_CHECK(max_bend_deg > 0.0, "max_bend_deg=", max_bend_deg);
  REGOLITH_CHECK(max_step > 0.0, "max_step=", max_step);
}

PointLabels SegmentGround(const LidarScan& scan, const RingImage& image,
                          const Eigen::Vector3d& up_lidar,
                          const GroundSegmentationOptions& options) {
  return GroundGrower(scan, image, up_lidar, options).Grow();
}

}  // namespace regolith
