// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"

namespace regolith {

/// How live measurements are brought into order. All times are those of stamps, so that the pace at
/// which they come does not matter.
struct EventMergerOptions {
  double hold = 0.3;           ///< s that a measurement waits for topics that are behind
  double silence = 1.0;        ///< s without a message, after which a topic is not waited for
  double max_ahead = 5.0;      ///< s; a stamp farther ahead of all others is astray …
  double max_behind = 2.0;     ///< s; … and one farther behind
  double jump_evidence = 0.5;  ///< s of astray measurements alone, that mean time itself jumped
  double max_gap = 60.0;       ///< s; a longer jump ahead is another time, not a gap

  void Check() const {
    REGOLITH_CHECK(hold >= 0.0, "hold=", hold);
    REGOLITH_CHECK(silence >= hold, "silence=", silence);
    REGOLITH_CHECK(max_ahead > silence, "max_ahead=", max_ahead);
    REGOLITH_CHECK(max_behind > hold, "max_behind=", max_behind);
    REGOLITH_CHECK(jump_evidence > 0.0, "jump_evidence=", jump_evidence);
    REGOLITH_CHECK(max_gap >= max_ahead, "max_gap=", max_gap);
  }
};

/// What live operation bears before it drops something.
struct LiveOptions {
  EventMergerOptions merger;
  int max_scans = 20;   ///< that wait to be worked off; then the oldest goes
  int max_images = 20;  ///< likewise
  int max_imu = 4000;   ///< IMU and wheel measurements, likewise
  double idle = 1.0;    ///< s of the clock without a measurement, after which none is held back

  void Check() const {
    merger.Check();
    REGOLITH_CHECK(max_scans >= 1, "max_scans=", max_scans);
    REGOLITH_CHECK(max_images >= 1, "max_images=", max_images);
    REGOLITH_CHECK(max_imu >= 1, "max_imu=", max_imu);
    REGOLITH_CHECK(idle > 0.0, "idle=", idle);
  }
};

}  // namespace regolith
