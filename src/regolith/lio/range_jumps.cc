// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/range_jumps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace regolith {

std::vector<uint32_t> PointsOffRangeJumps(const LidarScan& scan, const RangeJumpOptions& options) {
  constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> last_of_ring;
  std::vector<uint8_t> at_jump(scan.points.size(), 0);
  for (uint32_t i = 0; i < scan.points.size(); ++i) {
    const LidarPoint& point = scan.points[i];
    if (point.ring >= last_of_ring.size()) last_of_ring.resize(point.ring + size_t{1}, kNone);
    const uint32_t last = last_of_ring[point.ring];
    last_of_ring[point.ring] = i;
    if (last == kNone) continue;
    const Eigen::Vector3f& before = scan.points[last].position;
    const double near = std::min(before.norm(), point.position.norm());
    const double far = std::max(before.norm(), point.position.norm());
    const double sine = before.cross(point.position).norm() / std::max(near * far, 1e-9);
    const bool are_neighbours = before.dot(point.position) > 0.0F && sine <= options.max_angle;
    if (!are_neighbours || far - near <= options.step + options.slope * sine * near) continue;
    at_jump[last] = 1;
    at_jump[i] = 1;
  }
  std::vector<uint32_t> kept;
  kept.reserve(scan.points.size());
  for (uint32_t i = 0; i < scan.points.size(); ++i) {
    if (at_jump[i] == 0) kept.push_back(i);
  }
  return kept;
}

}  // namespace regolith
