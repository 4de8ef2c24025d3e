// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/kitti.h"
#include "regolith/io/text_input.h"

namespace regolith {
namespace {

/// Tells when a ring is complete: the azimuth, counted from the front, falls from a whole turn to
/// nothing. A ring counts only once it has been seen at the back, so that noise about the front
/// does not make rings of its own.
class RingCounter {
 public:
  /// The ring of the next point, 0 for the first ring of the file.
  int Next(const Eigen::Vector3f& point) {
    constexpr double kPi = 3.14159265358979323846;
    double azimuth = std::atan2(point.y(), point.x());
    if (azimuth < 0.0) azimuth += 2.0 * kPi;
    if (seen_back_ && azimuth < previous_ - kPi) {
      ++ring_;
      seen_back_ = false;
    }
    if (azimuth > 0.5 * kPi && azimuth < 1.5 * kPi) seen_back_ = true;
    previous_ = azimuth;
    return ring_;
  }

 private:
  double previous_ = 0.0;
  bool seen_back_ = false;
  int ring_ = 0;
};

}  // namespace

LidarScan ReadKittiScan(const std::string& path, int rings, size_t* invalid_points) {
  constexpr size_t kPointSize = 4 * sizeof(float);
  const std::string bytes = ReadFile(path);
  if (bytes.size() % kPointSize != 0) {
    throw InputError(path, Concatenate("has ", bytes.size(),
                                       " bytes; expected a multiple of 16 (x y z intensity)"));
  }
  LidarScan scan;
  scan.has_point_times = false;
  scan.points.reserve(bytes.size() / kPointSize);
  RingCounter counter;
  for (size_t offset = 0; offset < bytes.size(); offset += kPointSize) {
    LidarPoint point;
    std::memcpy(point.position.data(), bytes.data() + offset, 3 * sizeof(float));
    std::memcpy(&point.intensity, bytes.data() + offset + 3 * sizeof(float), sizeof(float));
    if (!point.position.allFinite()) {
      ++*invalid_points;
      continue;
    }
    point.ring =
        static_cast<uint16_t>(std::clamp(rings - 1 - counter.Next(point.position), 0, rings - 1));
    scan.points.push_back(point);
  }
  return scan;
}

}  // namespace regolith
