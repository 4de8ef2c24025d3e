// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/pose_error.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"
#include "regolith/geometry/so3.h"

namespace regolith {
namespace {

/// Distance along the path from its start to each pose, m.
std::vector<double> PathDistances(Span<const SE3> poses) {
  std::vector<double> distances(poses.size(), 0.0);
  for (size_t i = 1; i < poses.size(); ++i) {
    distances[i] = distances[i - 1] + (poses[i].translation - poses[i - 1].translation).norm();
  }
  return distances;
}

/// Index after `from` whose distance is nearest to `target`; the first of several. Distances do
/// not decrease, and one follows `from`.
size_t NearestAfter(const std::vector<double>& distances, size_t from, double target) {
  const auto begin = distances.begin() + static_cast<std::ptrdiff_t>(from) + 1;
  size_t best =
      static_cast<size_t>(std::lower_bound(begin, distances.end(), target) - distances.begin());
  if (best == distances.size()) --best;
  while (best > from + 1 &&
         std::abs(distances[best - 1] - target) <= std::abs(distances[best] - target)) {
    --best;
  }
  return best;
}

}  // namespace

PoseErrors AbsolutePoseErrors(Span<const SE3> reference, Span<const SE3> estimate) {
  REGOLITH_CHECK(reference.size() == estimate.size(), reference.size(), " and ", estimate.size());
  PoseErrors errors;
  for (size_t i = 0; i < reference.size(); ++i) {
    errors.translation.push_back((estimate[i].translation - reference[i].translation).norm());
    errors.angle.push_back(AngleBetween(reference[i].rotation, estimate[i].rotation));
  }
  return errors;
}

PoseErrors RelativePoseErrors(Span<const SE3> reference, Span<const SE3> estimate,
                              Span<const SegmentEnds> segments) {
  REGOLITH_CHECK(reference.size() == estimate.size(), reference.size(), " and ", estimate.size());
  PoseErrors errors;
  for (const SegmentEnds& segment : segments) {
    const SE3 reference_motion = reference[segment.from].Inverse() * reference[segment.to];
    const SE3 estimate_motion = estimate[segment.from].Inverse() * estimate[segment.to];
    const SE3 error = reference_motion.Inverse() * estimate_motion;
    errors.translation.push_back(error.translation.norm());
    errors.angle.push_back(LogSo3(error.rotation).norm());
  }
  return errors;
}

std::vector<SegmentEnds> ConsecutivePairs(size_t count) {
  std::vector<SegmentEnds> pairs;
  for (size_t i = 1; i < count; ++i) pairs.push_back({i - 1, i});
  return pairs;
}

std::vector<SegmentEnds> PairsByPathLength(Span<const SE3> poses, double length, double tolerance) {
  REGOLITH_CHECK(length > 0.0 && tolerance >= 0.0, length, " m, tolerance ", tolerance);
  const std::vector<double> distances = PathDistances(poses);
  std::vector<SegmentEnds> pairs;
  for (size_t from = 0; from + 1 < poses.size(); ++from) {
    const double target = distances[from] + length;
    const size_t to = NearestAfter(distances, from, target);
    if (std::abs(distances[to] - target) <= tolerance * length) pairs.push_back({from, to});
  }
  return pairs;
}

double PathLength(Span<const SE3> poses) {
  return poses.empty() ? 0.0 : PathDistances(poses).back();
}

}  // namespace regolith
