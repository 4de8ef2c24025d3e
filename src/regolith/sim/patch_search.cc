// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/patch_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/random.h"
#include "regolith/sim/rover_motion.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr int kCandidates = 400;
constexpr double kWantedSlope = 10.0 * kDegree;
constexpr double kKnownMargin = 3.0;  // m of real ground on all sides of the path

bool GroundIsKnown(const Surface& surface, Span<const PlanarPose> path,
                   const Eigen::Vector2d& offset) {
  return std::all_of(path.begin(), path.end(), [&](const PlanarPose& pose) {
    const Eigen::Vector2d place = pose.position + offset;
    return surface.Known(place.x(), place.y(), kKnownMargin);
  });
}

// Each pose a tenth of a second is finer than slopes over a metre need.
std::vector<PlanarPose> EveryFifth(Span<const PlanarPose> path) {
  std::vector<PlanarPose> sparse;
  for (size_t i = 0; i < path.size(); i += 5) sparse.push_back(path[i]);
  return sparse;
}

// Offsets for which the path stays in the surface's box.
Eigen::AlignedBox2d OffsetBox(const Surface& surface, Span<const PlanarPose> path) {
  Eigen::AlignedBox2d extent;
  for (const PlanarPose& pose : path) extent.extend(pose.position);
  const Eigen::AlignedBox2d box = surface.box();
  const Eigen::Vector2d low = box.min() - extent.min();
  const Eigen::Vector2d high = box.max() - extent.max();
  if ((high.array() <= low.array()).any()) {
    throw InputError(
        "elevation model",
        Concatenate("is ", box.sizes().x(), " x ", box.sizes().y(), " m, the path needs ",
                    extent.sizes().x(), " x ", extent.sizes().y(),
                    " m; use a larger model or a shorter --duration"));
  }
  return {low, high};
}

}  // namespace

Patch FindPatch(const Surface& surface, Span<const PlanarPose> path, double max_slope,
                uint64_t seed) {
  const std::vector<PlanarPose> sparse = EveryFifth(path);
  const Eigen::AlignedBox2d box = OffsetBox(surface, sparse);
  Random random(seed, "patch");
  Patch best;
  bool any_known = false;
  bool found = false;
  for (int i = 0; i < kCandidates; ++i) {
    Patch patch;
    patch.offset.x() = random.Uniform(box.min().x(), box.max().x());
    patch.offset.y() = random.Uniform(box.min().y(), box.max().y());
    if (!GroundIsKnown(surface, sparse, patch.offset)) continue;
    any_known = true;
    patch.steepest = SteepestSlope(surface, sparse, patch.offset);
    if (patch.steepest > 0.97 * max_slope) continue;
    if (!found || patch.steepest > best.steepest) best = patch;
    found = true;
    if (best.steepest >= kWantedSlope) break;
  }
  if (found) return best;
  if (!any_known) {
    throw InputError("elevation model",
                     "has no place without no-data where the path fits; crop a part with data or "
                     "shorten --duration");
  }
  throw InputError(
      "drive.max_slope_deg",
      Concatenate("none of ", kCandidates, " places has a path below ", max_slope / kDegree,
                  " degrees of slope; choose another --seed, gentler relief or a "
                  "flatter crop"));
}

}  // namespace regolith
