// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/sensor/image.h"

namespace regolith {

/// Grey values made wider: value → (value − low) · gain, cut to [0, 1].
struct ContrastStretch {
  double low = 0.0;   ///< grey / 255
  double gain = 1.0;  ///< at least 1

  double Apply(double value) const;
};

/// The stretch that brings the brightest thousandth of an image's pixels to white where the image
/// is dark, and takes off a veil that no pixel is darker than (dust, stray light). It is at most 4,
/// so that sensor noise stays noise; an image that uses its range stays as it is.
ContrastStretch StretchFor(const Image& image);

/// Standard deviation of the grey levels in the 7 × 7 pixels around one, cut at the image's edge.
double LocalContrast(const Image& image, int column, int row);

}  // namespace regolith
