// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"

namespace regolith {

/// Way (m) after which a match's error has gone into the map once. Calibrated by simulation
/// (docs/lidar.md): errors of position are new with every scan and hardly add up, those of rotation
/// repeat, since the ground is always seen under the same angles.
struct MapDriftOptions {
  double rotation_length = 1.0;
  double position_length = 40.0;

  void Check() const {
    REGOLITH_CHECK(rotation_length > 0.0, "rotation_length=", rotation_length);
    REGOLITH_CHECK(position_length > 0.0, "position_length=", position_length);
  }
};

}  // namespace regolith
