// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "regolith/core/span.h"
#include "regolith/eval/evaluation_options.h"
#include "regolith/geometry/alignment.h"
#include "regolith/geometry/trajectory.h"

namespace regolith {

/// Lays an estimate over its reference, pose i over pose i. Nothing where the mode leaves the
/// motion undetermined: fewer than three poses or positions on one line for kSe3 and kSim3,
/// positions on a vertical line for kYaw. Throws CheckError unless both are equally long and not
/// empty.
std::optional<Alignment> AlignTrajectory(Span<const StampedPose> reference,
                                         Span<const StampedPose> estimate, AlignmentMode mode);

/// The factor that would make the estimate as large as the reference (Umeyama 1991), whatever the
/// mode; nothing where AlignTrajectory(kSim3) has nothing.
std::optional<double> FitScale(Span<const StampedPose> reference, Span<const StampedPose> estimate);

}  // namespace regolith
