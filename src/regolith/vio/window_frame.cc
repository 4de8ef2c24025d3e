// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/vio/window_frame.h"

#include <algorithm>

namespace regolith {

void FrameMotion::Prepend(const FrameMotion& earlier) {
  std::vector<ImuSample> all = earlier.samples;
  for (const ImuSample& sample : samples) {
    if (all.empty() || sample.time > all.back().time) all.push_back(sample);
  }
  samples = std::move(all);
  is_doubtful = is_doubtful || earlier.is_doubtful;
  at_rest = at_rest && earlier.at_rest;
  way.reset();
}

void FrameMotion::KeepLast(double seconds) {
  const auto first = std::find_if(samples.begin(), samples.end(), [&](const ImuSample& sample) {
    return SecondsBetween(sample.time, samples.back().time) <= seconds;
  });
  samples.erase(samples.begin(), first);
}

}  // namespace regolith
