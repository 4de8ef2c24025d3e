// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace regolith {

/// Nanoseconds since an epoch that the recording chooses. Durations are doubles in seconds.
using TimeNs = int64_t;

inline constexpr double kNanosecondsPerSecond = 1e9;

/// Seconds from `start` to `end`; exact for spans below 100 days.
inline double SecondsBetween(TimeNs start, TimeNs end) {
  return static_cast<double>(end - start) / kNanosecondsPerSecond;
}

/// The time `seconds` after `start`, rounded to the nearest nanosecond.
inline TimeNs AddSeconds(TimeNs start, double seconds) {
  return start + static_cast<TimeNs>(std::llround(seconds * kNanosecondsPerSecond));
}

/// A time as seconds since its epoch; a double keeps about 0.2 µs of a date in this century.
inline double ToSeconds(TimeNs time) { return SecondsBetween(0, time); }

inline TimeNs FromSeconds(double seconds) { return AddSeconds(0, seconds); }

}  // namespace regolith
