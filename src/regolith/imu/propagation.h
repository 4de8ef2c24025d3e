// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/core/time.h"
#include "regolith/geometry/nav_state.h"
#include "regolith/sensor/imu_sample.h"

namespace regolith {

/// The state at to.time from the state at from.time by the midpoint rule: mean rotation rate, and
/// mean of the two specific forces turned into the world. The state's own biases are subtracted.
/// `gravity_world` in m/s², such as (0, 0, -1.62). Throws CheckError where `to` is not later.
NavState Propagate(const NavState& state, const ImuSample& from, const ImuSample& to,
                   const Eigen::Vector3d& gravity_world);

/// The state at `end` by all samples on the way there; beyond the last one its values hold. The
/// samples are sorted and there is one. Throws CheckError where `end` is not later.
NavState PropagateTo(NavState state, Span<const ImuSample> samples, TimeNs end,
                     const Eigen::Vector3d& gravity_world);

/// The measurement at `time` on the line between two samples.
ImuSample InterpolateSample(const ImuSample& from, const ImuSample& to, TimeNs time);

/// The samples from `start` to `end`, with interpolated ones at both ends, so that they cover just
/// this time. `samples` is sorted; beyond its ends the nearest sample holds. Empty where there are
/// no samples; throws CheckError unless start < end.
std::vector<ImuSample> SamplesBetween(Span<const ImuSample> samples, TimeNs start, TimeNs end);

}  // namespace regolith
