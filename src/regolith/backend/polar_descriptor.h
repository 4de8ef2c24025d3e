// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "regolith/backend/relief_match.h"
#include "regolith/core/span.h"

namespace regolith {

/// The shape of the ground around a place, whatever way the rover faces: amplitudes of the heights
/// (less a plane) over the azimuth, ring by ring. The idea is that of Scan Context (Kim and Kim
/// 2018); amplitudes of the angular frequencies take the place of its search over turns.
struct PolarDescriptor {
  static constexpr int kRings = 8;
  static constexpr int kOrders = 6;                  ///< angular frequencies 0 … 5
  std::array<float, kRings * kOrders> amplitudes{};  ///< m
};

/// `radius`: m, of the outermost ring.
PolarDescriptor DescribeRelief(Span<const ReliefImage::Cell> cells, double radius);

/// 0 for the same shape, about 1 for unrelated ones, at most 2.
double PolarDistance(const PolarDescriptor& first, const PolarDescriptor& second);

}  // namespace regolith
