// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/geometry/se3.h"

namespace regolith {

/// target ≈ scale · T_target_source * source.
struct Alignment {
  SE3 T_target_source;
  double scale = 1.0;
};

/// The similarity (or, without scale, rigid motion) of least squared error between paired points
/// (Umeyama 1991). Nothing for fewer than three pairs or for points on one line, where the rotation
/// is not determined.
std::optional<Alignment> AlignPoints(Span<const Eigen::Vector3d> source,
                                     Span<const Eigen::Vector3d> target, bool with_scale);

}  // namespace regolith
