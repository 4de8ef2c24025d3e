// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace regolith {

/// An 8-bit grey image that somebody else owns.
struct PixelView {
  const uint8_t* data = nullptr;
  ptrdiff_t stride = 0;  ///< bytes a row
};

/// Pixels that HarrisResponse looks at on every side.
inline constexpr int kHarrisReach = 4;
/// Pixels that PatchAngle looks at on every side.
inline constexpr int kPatchReach = 15;

/// Harris' measure (Harris & Stephens 1988, k = 0.04) over 7 × 7 pixels, of grey levels in 0…1.
float HarrisResponse(const PixelView& image, int column, int row);

/// Direction (radians, from x to y) from the pixel to the grey-weighted centre of the disc around
/// it (Rosin 1999).
float PatchAngle(const PixelView& image, int column, int row);

}  // namespace regolith
