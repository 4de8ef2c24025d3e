// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/ring_image.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"

namespace regolith {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;
// Bounds of the columns of a turn: coarser makes no neighbours, finer no spinning lidar.
constexpr int kFewestColumns = 90;
constexpr int kMostColumns = 4500;
// Rings whose azimuths are measured; all rings of a lidar fire at the same rate.
constexpr size_t kMeasuredRings = 4;
// Two azimuths closer than this are one firing seen twice.
constexpr double kSameAzimuth = 2e-4;  // rad
constexpr float kSmallestRange = 1e-3F;

struct RingReturn {
  double azimuth = 0.0;  ///< rad, 0 … 2 π
  float range = 0.0F;    ///< m
  int32_t index = 0;
};

/// The usable points of one ring in the scan's order, and where the ring looks.
struct Ring {
  std::vector<RingReturn> points;
  double elevation_sum = 0.0;

  double Elevation() const { return elevation_sum / static_cast<double>(points.size()); }
};

std::vector<Ring> SortByRing(const LidarScan& scan, int rings, int* invalid_points) {
  std::vector<Ring> sorted(static_cast<size_t>(rings));
  for (size_t i = 0; i < scan.points.size(); ++i) {
    const LidarPoint& point = scan.points[i];
    const float range = point.position.norm();
    if (point.ring >= rings || !std::isfinite(range) || range < kSmallestRange) {
      ++*invalid_points;
      continue;
    }
    const auto x = static_cast<double>(point.position.x());
    const auto y = static_cast<double>(point.position.y());
    double azimuth = std::atan2(y, x);
    if (azimuth < 0.0) azimuth += kTurn;
    Ring& ring = sorted[point.ring];
    ring.points.push_back({azimuth, range, static_cast<int32_t>(i)});
    ring.elevation_sum += std::asin(static_cast<double>(point.position.z() / range));
  }
  return sorted;
}

/// Removes empty rings and orders the others from the lowest; true where that changed their order.
bool OrderByElevation(std::vector<Ring>* rings) {
  rings->erase(std::remove_if(rings->begin(), rings->end(),
                              [](const Ring& ring) { return ring.points.empty(); }),
               rings->end());
  const auto lower = [](const Ring& first, const Ring& second) {
    return first.Elevation() < second.Elevation();
  };
  if (std::is_sorted(rings->begin(), rings->end(), lower)) return false;
  std::stable_sort(rings->begin(), rings->end(), lower);
  return true;
}

int CountColumns(const std::vector<Ring>& rings) {
  std::vector<const Ring*> fullest;
  for (const Ring& ring : rings) fullest.push_back(&ring);
  std::stable_sort(fullest.begin(), fullest.end(), [](const Ring* first, const Ring* second) {
    return first->points.size() > second->points.size();
  });
  fullest.resize(std::min(fullest.size(), kMeasuredRings));
  std::vector<double> steps;
  std::vector<double> azimuths;
  for (const Ring* ring : fullest) {
    azimuths.clear();
    for (const RingReturn& point : ring->points) azimuths.push_back(point.azimuth);
    std::sort(azimuths.begin(), azimuths.end());
    for (size_t i = 1; i < azimuths.size(); ++i) {
      const double step = azimuths[i] - azimuths[i - 1];
      if (step > kSameAzimuth) steps.push_back(step);
    }
  }
  if (steps.empty()) return kFewestColumns;
  const auto quartile = steps.begin() + static_cast<ptrdiff_t>(steps.size() / 4);
  std::nth_element(steps.begin(), quartile, steps.end());
  return std::clamp(static_cast<int>(std::lround(kTurn / *quartile)), kFewestColumns, kMostColumns);
}

void FillRow(const Ring& ring, int row, RingImage* image) {
  const double columns_per_radian = image->columns / kTurn;
  for (const RingReturn& point : ring.points) {
    const double place = point.azimuth * columns_per_radian;
    const int column = std::min(static_cast<int>(place), image->columns - 1);
    const bool upper_half = place - column > 0.5;
    const int beside = image->Wrap(upper_half ? column + 1 : column - 1);
    size_t cell = image->Cell(row, column);
    if (image->indices[cell] != RingImage::kEmpty) cell = image->Cell(row, beside);
    if (image->indices[cell] != RingImage::kEmpty) {
      ++image->crowded_points;
      continue;
    }
    image->indices[cell] = point.index;
    image->ranges[cell] = point.range;
  }
}

}  // namespace

std::optional<int> RingImage::Next(int row, int column, int direction, int reach) const {
  for (int step = 1; step <= reach; ++step) {
    const int beside = Wrap(column + direction * step);
    if (Index(row, beside) != kEmpty) return beside;
  }
  return std::nullopt;
}

std::optional<int> RingImage::Near(int row, int column) const {
  for (const int offset : {0, 1, -1}) {
    const int beside = Wrap(column + offset);
    if (Index(row, beside) != kEmpty) return beside;
  }
  return std::nullopt;
}

RingImage MakeRingImage(const LidarScan& scan, int rings) {
  REGOLITH_CHECK(rings > 0, "rings=", rings);
  RingImage image;
  std::vector<Ring> sorted = SortByRing(scan, rings, &image.invalid_points);
  image.rings_reordered = OrderByElevation(&sorted);
  image.rows = static_cast<int>(sorted.size());
  image.columns = CountColumns(sorted);
  const size_t cells = sorted.size() * static_cast<size_t>(image.columns);
  image.indices.assign(cells, RingImage::kEmpty);
  image.ranges.assign(cells, 0.0F);
  for (int row = 0; row < image.rows; ++row) {
    const Ring& ring = sorted[static_cast<size_t>(row)];
    image.elevations.push_back(static_cast<float>(ring.Elevation()));
    FillRow(ring, row, &image);
  }
  return image;
}

}  // namespace regolith
