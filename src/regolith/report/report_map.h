// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/report/report_data.h"

namespace regolith {

/// No more points of the map than this are shown; the page says so.
inline constexpr size_t kReportMapPoints = 300000;

/// Points as the page's renderer takes them: 8 bytes each, three 16-bit coordinates within the box
/// (little endian), intensity, 0.
struct PackedMap {
  std::vector<uint8_t> bytes;
  size_t count = 0;
  Eigen::Vector3f low = Eigen::Vector3f::Zero();
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
  /// The middle 96 per cent, so that a few stray points do not wash out the rest.
  Eigen::Vector2f heights = Eigen::Vector2f::Zero();
  Eigen::Vector2f intensities = Eigen::Vector2f::Zero();
};

PackedMap PackMap(Span<const ReportMapPoint> points);

/// Which of `total` things to keep so that at most `limit` are left: ascending, spread evenly, but
/// not every n-th, which would show as stripes. The same for the same numbers.
std::vector<size_t> ThinEvenly(size_t total, size_t limit);

}  // namespace regolith
