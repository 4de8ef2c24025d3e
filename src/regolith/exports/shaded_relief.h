// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/sensor/image.h"
#include "regolith/terrain/height_grid.h"

namespace regolith {

/// Where the light of a shaded relief comes from.
struct ReliefLight {
  double elevation_deg = 20.0;  ///< above the horizon
  double azimuth_deg = 315.0;   ///< clockwise from north; relief lit from the south looks inverted
};

/// Heights as a map lit by a low sun, north up, cast shadows included; at most `largest` pixels a
/// side. Posts without data are black.
Image ShadedRelief(const HeightGrid& grid, const ReliefLight& light, int largest);

}  // namespace regolith
