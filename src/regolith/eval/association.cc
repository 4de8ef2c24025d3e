// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/eval/association.h"

#include <algorithm>
#include <cmath>

namespace regolith {
namespace {

/// The double nearest to the stamp in seconds. Differences are taken between these, not between
/// nanoseconds, so that ties and the limit fall as they do for evo, which reads stamps as doubles.
std::vector<double> StampsInSeconds(Span<const StampedPose> poses) {
  std::vector<double> seconds;
  seconds.reserve(poses.size());
  for (const StampedPose& pose : poses) {
    seconds.push_back(static_cast<double>(static_cast<long double>(pose.time) / 1e9L));
  }
  return seconds;
}

/// Index of the stamp nearest to `time` in a sorted series that is not empty: of those not later
/// the last, of those later the first, and of these two the former where they are equally near.
size_t Nearest(const std::vector<double>& stamps, double time) {
  const auto later = std::upper_bound(stamps.begin(), stamps.end(), time);
  if (later == stamps.begin()) return 0;
  const size_t after = static_cast<size_t>(later - stamps.begin());
  if (after == stamps.size()) return after - 1;
  return stamps[after] - time < time - stamps[after - 1] ? after : after - 1;
}

}  // namespace

std::vector<PosePair> AssociateByTime(Span<const StampedPose> reference,
                                      Span<const StampedPose> estimate, double max_difference) {
  std::vector<PosePair> pairs;
  if (reference.empty() || estimate.empty()) return pairs;
  const std::vector<double> reference_stamps = StampsInSeconds(reference);
  const std::vector<double> estimate_stamps = StampsInSeconds(estimate);
  const bool reference_leads = estimate.size() > reference.size();
  const std::vector<double>& leading = reference_leads ? reference_stamps : estimate_stamps;
  const std::vector<double>& searched = reference_leads ? estimate_stamps : reference_stamps;
  pairs.reserve(leading.size());
  for (size_t i = 0; i < leading.size(); ++i) {
    const size_t nearest = Nearest(searched, leading[i]);
    if (std::abs(searched[nearest] - leading[i]) > max_difference) continue;
    pairs.push_back(reference_leads ? PosePair{i, nearest} : PosePair{nearest, i});
  }
  return pairs;
}

}  // namespace regolith
