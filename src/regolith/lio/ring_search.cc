// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/ring_search.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Rings that count as close by.
constexpr int kRingReach = 2;
constexpr int kNoRow = -1;
// Sine of the angle at the nearest point below which three points make no plane.
constexpr double kLeastSpread = 0.1;

double AzimuthOf(const Eigen::Vector3d& position) { return std::atan2(position.y(), position.x()); }

}  // namespace

RingSearch::RingSearch(std::vector<RingPoint> points) {
  for (const RingPoint& point : points) {
    const auto row = static_cast<size_t>(point.row);
    if (row >= rows_.size()) rows_.resize(row + 1);
    rows_[row].push_back({AzimuthOf(point.position), point.position});
  }
  for (std::vector<Feature>& row : rows_) {
    std::stable_sort(row.begin(), row.end(), [](const Feature& first, const Feature& second) {
      return first.azimuth < second.azimuth;
    });
  }
}

void RingSearch::SearchRow(const Eigen::Vector3d& query, int row, const Hit* skipped,
                           double max_distance, std::optional<Hit>* best) const {
  const std::vector<Feature>& features = rows_[static_cast<size_t>(row)];
  if (features.empty()) return;
  const double azimuth = AzimuthOf(query);
  const double radius = query.head<2>().norm();
  const auto after = std::lower_bound(
      features.begin(), features.end(), azimuth,
      [](const Feature& feature, double value) { return feature.azimuth < value; });
  const auto start = static_cast<size_t>(after - features.begin());
  const size_t count = features.size();
  // From the query's azimuth to either side, as far as the half-plane of an azimuth is nearer than
  // what has been found.
  for (const bool forward : {true, false}) {
    for (size_t step = 0; step < count; ++step) {
      const size_t place =
          forward ? (start + step) % count : (start + 2 * count - 1 - step) % count;
      const double limit = *best ? (*best)->distance : max_distance;
      const double turn = std::abs(std::remainder(features[place].azimuth - azimuth, 2.0 * kPi));
      if (turn > 0.5 * kPi || radius * std::sin(turn) >= limit) break;
      if (skipped && skipped->row == row && skipped->place == place) continue;
      const double distance = (features[place].position - query).norm();
      if (distance < limit) *best = Hit{row, place, distance};
    }
  }
}

std::optional<RingSearch::Hit> RingSearch::Nearest(const Eigen::Vector3d& query, int first,
                                                   int last, int skipped_row, const Hit* skipped,
                                                   double max_distance) const {
  std::optional<Hit> best;
  first = std::max(first, 0);
  last = std::min(last, static_cast<int>(rows_.size()) - 1);
  for (int row = first; row <= last; ++row) {
    if (row != skipped_row) SearchRow(query, row, skipped, max_distance, &best);
  }
  return best;
}

std::optional<RingSearch::Hit> RingSearch::NearestOfOtherRing(const Eigen::Vector3d& query,
                                                              const Hit& nearest,
                                                              double max_distance) const {
  return Nearest(query, nearest.row - kRingReach, nearest.row + kRingReach, nearest.row, nullptr,
                 max_distance);
}

FeatureLine RingSearch::FindLine(const Eigen::Vector3d& query, double max_distance) const {
  const auto nearest =
      Nearest(query, 0, static_cast<int>(rows_.size()) - 1, kNoRow, nullptr, max_distance);
  if (!nearest) return {};
  const auto second = NearestOfOtherRing(query, *nearest, max_distance);
  if (!second) return {};
  return {true, At(*nearest), (At(*second) - At(*nearest)).normalized()};
}

FeaturePlane RingSearch::FindPlane(const Eigen::Vector3d& query, double max_distance) const {
  const auto nearest =
      Nearest(query, 0, static_cast<int>(rows_.size()) - 1, kNoRow, nullptr, max_distance);
  if (!nearest) return {};
  const auto second = Nearest(query, nearest->row, nearest->row, kNoRow, &*nearest, max_distance);
  const auto third = NearestOfOtherRing(query, *nearest, max_distance);
  if (!second || !third) return {};
  const Eigen::Vector3d along = (At(*second) - At(*nearest)).normalized();
  const Eigen::Vector3d across = (At(*third) - At(*nearest)).normalized();
  const Eigen::Vector3d normal = along.cross(across);
  const double sine = normal.norm();
  if (!(sine > kLeastSpread)) return {};
  return {true, At(*nearest), normal / sine};
}

}  // namespace regolith
