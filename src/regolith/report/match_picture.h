// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"

namespace regolith {

/// A grey image and what was found in it.
struct MatchPanel {
  int width = 0;
  int height = 0;
  Span<const uint8_t> grey;               ///< width × height, row by row
  Span<const Eigen::Vector2f> keypoints;  ///< pixels
};

/// How a match is drawn.
enum class MatchStyle {
  kRejected,  ///< faint grey, below the others
  kKept,      ///< by outlier rejection; greens and blues
  kCorrect,   ///< kept, and truth agrees: the same
  kWrong,     ///< kept, and truth does not: red
  kUnknown,   ///< kept, and truth does not say: amber
};

struct MatchLine {
  Eigen::Vector2f first = Eigen::Vector2f::Zero();
  Eigen::Vector2f second = Eigen::Vector2f::Zero();
  MatchStyle style = MatchStyle::kKept;
};

/// A PNG of two images side by side at one scale, their keypoints as red dots, their matches as
/// lines from one to the other, and lines of text below. Small images are enlarged and large ones
/// reduced, so that the picture fits a page. The same bytes for the same values.
std::vector<uint8_t> DrawMatches(const MatchPanel& first, const MatchPanel& second,
                                 Span<const MatchLine> matches,
                                 const std::vector<std::string>& caption);

}  // namespace regolith
